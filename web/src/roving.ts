/** A long list of buttons is one stop of the Tab key: the arrow keys go from one to the next. */

/** `box`: the buttons in it may come and go; the one with aria-current is the first to be reached. */
export function rove(box: HTMLElement): void {
  const buttons = (): HTMLElement[] => [...box.querySelectorAll<HTMLElement>("button")];
  const stopAt = (wanted: HTMLElement | undefined): void => {
    for (const button of buttons()) {
      const index = button === wanted ? 0 : -1;
      if (button.tabIndex !== index) button.tabIndex = index;
    }
  };
  const settle = (): void => {
    const all = buttons();
    const focused = all.find((button) => button === document.activeElement);
    stopAt(focused ?? all.find((button) => button.ariaCurrent === "true") ?? all[0]);
  };
  new MutationObserver(settle).observe(box, { childList: true, subtree: true, attributeFilter: ["aria-current"] });
  box.addEventListener("focusin", settle);
  box.addEventListener("keydown", (event) => {
    const all = buttons();
    const at = all.indexOf(document.activeElement as HTMLElement);
    if (at < 0 || event.ctrlKey || event.altKey || event.metaKey) return;
    const goals: Record<string, number> = {
      ArrowDown: at + 1,
      ArrowRight: at + 1,
      ArrowUp: at - 1,
      ArrowLeft: at - 1,
      Home: 0,
      End: all.length - 1,
    };
    const goal = all[goals[event.key] ?? -1];
    if (!goal) return;
    event.preventDefault();
    goal.focus();
  });
  settle();
}
