# LinuxCNC's G-code interpreter, which judges our tapes: taken out of Debian's packages without installing them. Who has
# no apt goes without; the tests that need it are skipped then.
RS274 := build/linuxcnc
RS274_PACKAGES := linuxcnc-uspace libboost-python1.74.0 libmodbus5

rs274:
	@test -x $(RS274)/usr/bin/rs274 || { rm -rf $(RS274) && mkdir -p $(RS274)/packages && cd $(RS274)/packages \
		&& { apt-get download -qq $(RS274_PACKAGES) 2>/dev/null || { [ "$$(id -u)" = 0 ] && apt-get update -qq \
			&& apt-get download -qq $(RS274_PACKAGES); }; } \
		&& for package in *.deb; do dpkg -x $$package .. || exit 1; done \
		&& cd .. && rm -rf packages usr/share etc; } \
	|| { rm -rf $(RS274); echo "No LinuxCNC, some tests are skipped: they take it from Debian's package linuxcnc-uspace"; }

.PHONY: rs274
