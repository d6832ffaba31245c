/* skg.exe: SKG on Windows, from a folder that was only unpacked. Python and the package lie in `python` beside it.
 *
 * With words it is the command: they go to `python -m skg` as they came, with the same streams; its exit code is this one's.
 * By a double click, or with a drawing dropped on it, it runs `skg ui`, opens the browser and shows a small window. What
 * fails then is told in a message box, since nobody sees a console.
 *
 * It is a program of the console: only for these the command line waits. A double click would give it a console of its
 * own; the manifest asks newer Windows for none, and on older ones it is given up at once.
 *
 * `--register` puts "Open with SKG" into the menus of drawings and job files, for this user alone; `--unregister` takes it out. */
#define UNICODE
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#include <shellapi.h>
#include <shlobj.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>

#include "skg.h"

/** Exit code where Python does not run; that of wrong usage. */
#define NOT_RUN 2
/** So much of what Python said is kept for a message box, bytes. */
#define MOST_SAID 4000
/** Messages of the window: the page's address has come; Python has ended. */
#define WM_ADDRESS (WM_APP + 1)
#define WM_ENDED (WM_APP + 2)

/** Words in one of the languages. */
typedef struct {
    const wchar_t *incomplete, *no_browser, *one_drawing, *not_registered, *registered, *unregistered;
    const wchar_t *open_with, *starting, *running, *open, *copy, *quit, *no_drawing, *ended;
    const wchar_t *lang;
} words_t;

static const words_t ENGLISH = {
    .incomplete = L"Python is not there or does not start. Unpack the whole zip (Extract All), and start skg.exe in the new folder.",
    .no_browser = L"No browser opened. Copy the address, and paste it into a browser.",
    .one_drawing = L"Drop one drawing at a time.",
    .not_registered = L"The menus were not changed.",
    .registered = L"\"Open with SKG\" is in the menus of .dxf, .svg and .job.toml (Windows 11: under \"Show more options\").",
    .unregistered = L"\"Open with SKG\" is out of the menus.",
    .open_with = L"Open with SKG",
    .starting = L"Starting \x2026",
    .running = L"The page is in the browser. SKG ends ten minutes after it was closed.",
    .open = L"&Open in browser",
    .copy = L"&Copy address",
    .quit = L"&Quit",
    .no_drawing = L"The page asks for a drawing",
    .ended = L"SKG has ended.",
    .lang = L"en",
};

static const words_t CHINESE = {
    .incomplete = L"找不到 Python，或者它不能启动。请把整个 zip 解压（“全部解压缩”），再从新文件夹里启动 skg.exe。",
    .no_browser = L"没有打开浏览器。请复制地址，粘贴到浏览器里。",
    .one_drawing = L"一次只能拖放一张图纸。",
    .not_registered = L"没有改动右键菜单。",
    .registered = L".dxf、.svg、.job.toml 的右键菜单里有了“用 SKG 打开”（Windows 11：在“显示更多选项”里）。",
    .unregistered = L"右键菜单里的“用 SKG 打开”已去掉。",
    .open_with = L"用 SKG 打开",
    .starting = L"正在启动……",
    .running = L"网页在浏览器里。关闭网页十分钟后，SKG 自动结束。",
    .open = L"在浏览器中打开(&O)",
    .copy = L"复制地址(&C)",
    .quit = L"退出(&Q)",
    .no_drawing = L"请在网页中选择图纸",
    .ended = L"SKG 已结束。",
    .lang = L"zh",
};

static const words_t *words = &ENGLISH;
/** The path of this program, and its folder with a backslash behind. */
static wchar_t program[32768], folder[32768];
/** Whether a console that others use too is there: the command was typed. */
static bool is_typed;

// Messages

/** Tell something: on the console where there is one, else in a message box. */
static void tell(UINT icon, const wchar_t *text) {
    if (!is_typed) {
        MessageBoxW(NULL, text, L"SKG", MB_OK | MB_SETFOREGROUND | icon);
        return;
    }
    HANDLE stream = GetStdHandle(icon == MB_ICONERROR ? STD_ERROR_HANDLE : STD_OUTPUT_HANDLE);
    DWORD mode, written;
    if (GetConsoleMode(stream, &mode)) {
        WriteConsoleW(stream, text, (DWORD)wcslen(text), &written, NULL);
        WriteConsoleW(stream, L"\r\n", 2, &written, NULL);
    } else {
        char bytes[8192];
        int count = WideCharToMultiByte(CP_ACP, 0, text, -1, bytes, sizeof bytes - 2, NULL, NULL);
        if (count > 0) {
            bytes[count - 1] = '\n';
            WriteFile(stream, bytes, (DWORD)count, &written, NULL);
        }
    }
}

/** Tell what failed, with the reason that Windows gives: the exit code. */
static int fail(const wchar_t *what, DWORD error) {
    static wchar_t text[34000];
    wchar_t reason[512] = L"";
    FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, NULL, error, 0, reason, 512, NULL);
    reason[wcscspn(reason, L"\r\n")] = 0;
    swprintf(text, sizeof text / sizeof *text, L"%ls\r\n\r\n%lspython\\python.exe: %ls (%lu)", what, folder, reason, error);
    tell(MB_ICONERROR, text);
    return NOT_RUN;
}

// Python

/** Start Python with words behind `python.exe`, and streams; its process, or NULL with the last error. */
static HANDLE start(const wchar_t *arguments, HANDLE in, HANDLE out, HANDLE err, DWORD flags) {
    static wchar_t line[32768];
    static wchar_t python[32768];
    swprintf(python, 32768, L"%lspython\\python.exe", folder);
    if (swprintf(line, 32768, L"\"%ls\" %ls", python, arguments) < 0) {
        SetLastError(ERROR_FILENAME_EXCED_RANGE);
        return NULL;
    }
    STARTUPINFOW with = {.cb = sizeof with, .dwFlags = STARTF_USESTDHANDLES};
    HANDLE streams[] = {in, out, err};
    for (int i = 0; i < 3; i++) {
        if (streams[i] && streams[i] != INVALID_HANDLE_VALUE) SetHandleInformation(streams[i], HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
    }
    with.hStdInput = in;
    with.hStdOutput = out;
    with.hStdError = err;
    PROCESS_INFORMATION made;
    if (!CreateProcessW(python, line, NULL, NULL, TRUE, flags | CREATE_SUSPENDED, NULL, NULL, &with, &made)) return NULL;
    // It ends with this one, however that ends; a browser that it starts does not.
    HANDLE job = CreateJobObjectW(NULL, NULL);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {
        .BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_SILENT_BREAKAWAY_OK};
    SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    AssignProcessToJobObject(job, made.hProcess);
    ResumeThread(made.hThread);
    CloseHandle(made.hThread);
    return made.hProcess;
}

/** Ctrl-C is for Python; this process waits for what becomes of it. */
static BOOL WINAPI leave_to_python(DWORD event) {
    return event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
}

/** The command line behind the program's own name. */
static const wchar_t *behind_name(const wchar_t *line) {
    bool is_quoted = false;
    for (; *line && (is_quoted || (*line != L' ' && *line != L'\t')); line++) {
        if (*line == L'"') is_quoted = !is_quoted;
    }
    return line + wcsspn(line, L" \t");
}

static int run_command(const wchar_t *arguments) {
    static wchar_t line[32768];
    if (swprintf(line, 32768, L"-m skg %ls", arguments) < 0) return fail(words->incomplete, ERROR_FILENAME_EXCED_RANGE);
    SetConsoleCtrlHandler(leave_to_python, TRUE);
    // (without a console of this one Python would open a window for its own)
    DWORD ids[1], flags = GetConsoleProcessList(ids, 1) ? 0 : CREATE_NO_WINDOW;
    HANDLE python =
        start(line, GetStdHandle(STD_INPUT_HANDLE), GetStdHandle(STD_OUTPUT_HANDLE), GetStdHandle(STD_ERROR_HANDLE), flags);
    if (!python) return fail(words->incomplete, GetLastError());
    DWORD code = NOT_RUN;
    WaitForSingleObject(python, INFINITE);
    GetExitCodeProcess(python, &code);
    return (int)code;
}

// The window

static HWND window;
static HANDLE python_process, python_input, python_output;
/** The page's address; what else Python said, UTF-8, its end. */
static wchar_t address[512];
static char said[MOST_SAID + 1];
static wchar_t drawing[32768];

/** Take what Python says: the first line that is an address, and all else. Runs in a thread of its own. */
static DWORD WINAPI listen(LPVOID nothing) {
    (void)nothing;
    char part[512], line[1024];
    size_t length = 0, kept = 0;
    DWORD count;
    while (ReadFile(python_output, part, sizeof part, &count, NULL) && count) {
        for (DWORD i = 0; i < count; i++) {
            if (part[i] == '\r') continue;
            if (length < sizeof line - 1) line[length++] = part[i];
            if (part[i] != '\n') continue;
            line[length] = 0;
            if (!address[0] && !strncmp(line, "http://", 7)) {
                line[strcspn(line, "\n")] = 0;
                MultiByteToWideChar(CP_UTF8, 0, line, -1, address, 512);
                PostMessageW(window, WM_ADDRESS, 0, 0);
            } else if (kept + length < MOST_SAID) {
                memcpy(said + kept, line, length + 1);
                kept += length;
            }
            length = 0;
        }
    }
    DWORD code = NOT_RUN;
    WaitForSingleObject(python_process, INFINITE);
    GetExitCodeProcess(python_process, &code);
    PostMessageW(window, WM_ENDED, code, 0);
    return 0;
}

static void open_page(void) {
    if ((INT_PTR)ShellExecuteW(window, L"open", address, NULL, NULL, SW_SHOWNORMAL) <= 32) {
        MessageBoxW(window, words->no_browser, L"SKG", MB_OK | MB_ICONWARNING);
    }
}

static void copy_address(void) {
    size_t size = (wcslen(address) + 1) * sizeof *address;
    HGLOBAL memory = GlobalAlloc(GMEM_MOVEABLE, size);
    if (!memory || !OpenClipboard(window)) return;
    memcpy(GlobalLock(memory), address, size);
    GlobalUnlock(memory);
    EmptyClipboard();
    SetClipboardData(CF_UNICODETEXT, memory);
    CloseClipboard();
}

/** Let Python end: it writes what was set and not saved. */
static void quit(void) {
    if (python_input) CloseHandle(python_input);
    python_input = NULL;
    EnableWindow(GetDlgItem(window, ID_QUIT), FALSE);
}

/** The end of Python: its last words, if there are any, with an icon of how bad they are. */
static void tell_end(DWORD code) {
    static wchar_t text[MOST_SAID + 1];
    MultiByteToWideChar(CP_UTF8, 0, said, -1, text, MOST_SAID + 1);
    if (code && !text[0]) swprintf(text, MOST_SAID, L"%ls (%lu)", words->ended, code);
    if (text[0]) MessageBoxW(window, text, L"SKG", MB_OK | MB_SETFOREGROUND | (code ? MB_ICONERROR : MB_ICONINFORMATION));
}

static INT_PTR CALLBACK on_message(HWND dialog, UINT message, WPARAM first, LPARAM second) {
    (void)second;
    switch (message) {
        case WM_INITDIALOG: {
            window = dialog;
            HICON icon = LoadIconW(GetModuleHandleW(NULL), MAKEINTRESOURCEW(ID_ICON));
            SendMessageW(dialog, WM_SETICON, ICON_BIG, (LPARAM)icon);
            SendMessageW(dialog, WM_SETICON, ICON_SMALL, (LPARAM)icon);
            const wchar_t *name = wcsrchr(drawing, L'\\');
            SetDlgItemTextW(dialog, ID_DRAWING, !drawing[0] ? words->no_drawing : name ? name + 1 : drawing);
            SetDlgItemTextW(dialog, ID_STATE, words->starting);
            SetDlgItemTextW(dialog, ID_OPEN, words->open);
            SetDlgItemTextW(dialog, ID_COPY, words->copy);
            SetDlgItemTextW(dialog, ID_QUIT, words->quit);
            CloseHandle(CreateThread(NULL, 0, listen, NULL, 0, NULL));
            return TRUE;
        }
        case WM_ADDRESS:
            SetDlgItemTextW(dialog, ID_STATE, words->running);
            EnableWindow(GetDlgItem(dialog, ID_OPEN), TRUE);
            EnableWindow(GetDlgItem(dialog, ID_COPY), TRUE);
            open_page();
            return TRUE;
        case WM_ENDED:
            ShowWindow(dialog, SW_HIDE);
            tell_end((DWORD)first);
            EndDialog(dialog, (INT_PTR)first);
            return TRUE;
        case WM_COMMAND:
            if (LOWORD(first) == ID_OPEN) open_page();
            if (LOWORD(first) == ID_COPY) copy_address();
            if (LOWORD(first) == ID_QUIT || LOWORD(first) == IDCANCEL) quit();
            return TRUE;
        default:
            return FALSE;
    }
}

static int show_drawing(const wchar_t *file) {
    static wchar_t line[32768];
    FreeConsole();
    is_typed = false;
    wcsncpy(drawing, file, 32767);
    SECURITY_ATTRIBUTES inherited = {.nLength = sizeof inherited, .bInheritHandle = FALSE};
    HANDLE their_input, their_output;
    if (!CreatePipe(&their_input, &python_input, &inherited, 0) || !CreatePipe(&python_output, &their_output, &inherited, 0)) {
        return fail(words->incomplete, GetLastError());
    }
    const wchar_t *quote = file[0] ? L"\"" : L"";
    int length = swprintf(line, 32768, L"-X utf8 -m skg --lang %ls ui --no-browser --until-eof %ls%ls%ls", words->lang, quote, file, quote);
    python_process = length < 0 ? NULL : start(line, their_input, their_output, their_output, CREATE_NO_WINDOW);
    if (!python_process) return fail(words->incomplete, length < 0 ? ERROR_FILENAME_EXCED_RANGE : GetLastError());
    CloseHandle(their_input);
    CloseHandle(their_output);
    INT_PTR code = DialogBoxParamW(GetModuleHandleW(NULL), MAKEINTRESOURCEW(ID_WINDOW), NULL, on_message, 0);
    return code < 0 ? fail(words->ended, GetLastError()) : (int)code;
}

// The menus of Explorer

/** Endings with the menu's entry; the last one only where the file's name ends in it. */
static const struct {
    const wchar_t *ending, *applies_to;
} DRAWINGS[] = {{L".dxf", NULL}, {L".svg", NULL}, {L".toml", L"System.FileName:~\"*.job.toml\""}};

/** The key of an ending's entry, of this user. */
static void key_of(wchar_t *key, size_t size, const wchar_t *ending, const wchar_t *more) {
    swprintf(key, size, L"Software\\Classes\\SystemFileAssociations\\%ls\\shell\\SKG%ls", ending, more);
}

static LSTATUS write_value(const wchar_t *key, const wchar_t *name, const wchar_t *value) {
    return RegSetKeyValueW(HKEY_CURRENT_USER, key, name, REG_SZ, value, (DWORD)((wcslen(value) + 1) * sizeof *value));
}

static int change_menus(bool is_wanted) {
    static wchar_t command[32800];
    wchar_t key[256];
    LSTATUS error = ERROR_SUCCESS;
    swprintf(command, 32800, L"\"%ls\" \"%%1\"", program);
    for (size_t i = 0; i < sizeof DRAWINGS / sizeof *DRAWINGS && !error; i++) {
        key_of(key, 256, DRAWINGS[i].ending, L"");
        LSTATUS taken_out = RegDeleteTreeW(HKEY_CURRENT_USER, key);
        if (!is_wanted) {
            error = taken_out == ERROR_FILE_NOT_FOUND ? ERROR_SUCCESS : taken_out;
            continue;
        }
        error = write_value(key, L"MUIVerb", words->open_with);
        if (!error) error = write_value(key, L"Icon", program);
        if (!error && DRAWINGS[i].applies_to) error = write_value(key, L"AppliesTo", DRAWINGS[i].applies_to);
        key_of(key, 256, DRAWINGS[i].ending, L"\\command");
        if (!error) error = write_value(key, NULL, command);
    }
    if (error) return fail(words->not_registered, (DWORD)error);
    SHChangeNotify(SHCNE_ASSOCCHANGED, SHCNF_IDLIST, NULL, NULL);
    tell(MB_ICONINFORMATION, is_wanted ? words->registered : words->unregistered);
    return 0;
}

/** A path as Explorer hands it over, from its root. */
static bool is_path(const wchar_t *word) {
    return (word[0] && word[1] == L':') || (word[0] == L'\\' && word[1] == L'\\');
}

int main(void) {
    if (PRIMARYLANGID(GetUserDefaultUILanguage()) == LANG_CHINESE) words = &CHINESE;
    GetModuleFileNameW(NULL, program, 32768);
    wcscpy(folder, program);
    wchar_t *last = wcsrchr(folder, L'\\');
    if (last) last[1] = 0;
    DWORD ids[2];
    is_typed = GetConsoleProcessList(ids, 2) > 1;
    int count;
    const wchar_t *line = GetCommandLineW();
    wchar_t **arguments = CommandLineToArgvW(line, &count);
    if (count == 2 && !wcscmp(arguments[1], L"--register")) return change_menus(true);
    if (count == 2 && !wcscmp(arguments[1], L"--unregister")) return change_menus(false);
    if (count > 1 && !is_path(arguments[1])) return run_command(behind_name(line));
    if (count == 1 && is_typed) return run_command(L"");
    if (count > 2) {
        tell(MB_ICONERROR, words->one_drawing);
        return NOT_RUN;
    }
    return show_drawing(count == 2 ? arguments[1] : L"");
}
