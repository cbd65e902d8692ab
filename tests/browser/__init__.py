"""Reports in a real browser: Chromium, headless, driven through its DevTools protocol by a pipe."""
