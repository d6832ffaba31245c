"""The drawing on the screen: a server on this machine for the page in a browser, and a process that reads and cuts."""
