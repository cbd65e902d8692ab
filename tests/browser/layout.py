"""Does a page read well? Measured in the browser: `python -m tests.browser.layout results/NAME/report.html …`."""

import sys
from pathlib import Path

from tests.browser.chromium import Chromium, find_chromium

WIDTHS = (390, 1366)  # a phone, a laptop
PAPER = 718  # px of A4 between its margins of 1 cm
SMALLEST = 9.0  # px; text of a figure on the phone
MEASURE = """(smallest) => {
  const found = [], wide = document.documentElement.clientWidth, name = (e) =>
    `${e.tagName.toLowerCase()}${e.id ? '#' + e.id : ''} "${(e.textContent || '').trim().slice(0, 30)}"`;
  const seen = (r) => r.width > 0 && r.height > 0;
  if (document.documentElement.scrollWidth > wide) {
    found.push(`scrolls sideways: ${document.documentElement.scrollWidth} px in ${wide}`);
  }
  const scrolls = (e) => { for (; e; e = e.parentElement) {
    if (['auto', 'scroll'].includes(getComputedStyle(e).overflowX)) return true; } return false; };
  for (const e of document.body.querySelectorAll('*')) {
    if (e.closest('svg') && e.tagName !== 'svg') continue;
    const r = e.getBoundingClientRect(), style = getComputedStyle(e);
    if (seen(r) && (r.right > wide + 1 || r.left < -1) && !scrolls(e)) found.push(`leaves the page: ${name(e)}`);
    const clips = ['hidden', 'clip'].includes(style.overflowX) && e.scrollWidth > e.clientWidth + 1;
    if (seen(r) && clips && e.tagName !== 'svg' && e.textContent.trim()) found.push(`cut: ${name(e)}`);
  }
  for (const svg of document.querySelectorAll('svg')) {
    const frame = svg.getBoundingClientRect();
    if (!seen(frame)) continue;
    const labels = [...svg.querySelectorAll('text')].filter((t) => t.textContent.trim());
    const places = labels.map((t) => t.getBoundingClientRect());
    labels.forEach((text, k) => {
      const r = places[k];
      if (!seen(r)) return;
      const m = text.getScreenCTM(), size = parseFloat(getComputedStyle(text).fontSize) * Math.hypot(m.a, m.b);
      if (size < smallest - 0.05) found.push(`${size.toFixed(1)} px: ${name(text)}`);
      const out = Math.max(frame.left - r.left, r.right - frame.right, frame.top - r.top, r.bottom - frame.bottom);
      if (out > 1.5) found.push(`cut by ${out.toFixed(1)} px: ${name(text)}`);
      for (let i = 0; i < k; i++) {
        const o = places[i], slack = 0.2 * Math.min(r.height, o.height);
        const across = Math.min(r.right, o.right) - Math.max(r.left, o.left);
        const down = Math.min(r.bottom, o.bottom) - Math.max(r.top, o.top);
        if (seen(o) && across > 1 && down > slack) found.push(`overlap: ${name(labels[i])} and ${name(text)}`);
      }
    });
    const outlines = [...svg.querySelectorAll('g[id^="text_"]')].filter((g) => !g.querySelector('text'));
    if (outlines.length) found.push(`${outlines.length} labels drawn as outlines, no text`);
  }
  return found;
}"""


def measure_layout(browser: Chromium, page: Path) -> list[str]:
    """What is wrong with a page at both widths, light and dark, and on paper; empty if it reads well."""
    findings = []
    for width in WIDTHS:
        for dark in (False, True):
            browser.open(page, width, dark=dark)
            smallest = SMALLEST if width == WIDTHS[0] else 0.0
            place = f"{width} px, {'dark' if dark else 'light'}: "
            findings += [place + text for text in browser.evaluate(f"({MEASURE})({smallest})")]
            findings += [place + "console: " + text for text in browser.complaints()]
    browser.open(page, PAPER, media="print")
    browser.evaluate("dispatchEvent(new Event('beforeprint'))")
    browser.settle()
    return findings + [f"A4: {text}" for text in browser.evaluate(f"({MEASURE})(0)")]


def main(pages: list[str]) -> int:
    program = find_chromium()
    if program is None:
        print("Chromium is not installed", file=sys.stderr)
        return 2
    browser = Chromium(program)
    try:
        findings = [f"{page}: {text}" for page in pages for text in measure_layout(browser, Path(page))]
    finally:
        browser.close()
    print("\n".join(findings) or "nothing to complain of")
    return int(bool(findings))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
