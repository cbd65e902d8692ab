"""CPU time of the page's script for each frame of a long law: `python -m tests.browser.frame_time [--legs 999]`."""

import argparse
import sys
import tempfile
from pathlib import Path

from tests.browser.chromium import Chromium, find_chromium
from tests.browser.pages import make_law, write_page

FRAMES = 200
# what a frame costs: the state of the body and the picture, without and with a turned view; and the start
MEASURE = """async (frames) => {
  const player = document.querySelector('.motion').player, found = {};
  const acts = {
    playing: (k) => player.seek((player.law.duration * (k + 0.5)) / frames),
    turning: (k) => player.turnView(0.02, 0),
  };
  for (const [name, act] of Object.entries(acts)) {
    const before = performance.now();
    let longest = 0;
    for (let k = 0; k < frames; k++) {
      const start = performance.now();
      act(k);
      longest = Math.max(longest, performance.now() - start);
    }
    found[name] = [(performance.now() - before) / frames, longest];
    await new Promise((done) => requestAnimationFrame(done));
  }
  return found;
}"""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--legs", type=int, default=999)
    legs = parser.parse_args().legs
    program = find_chromium()
    if program is None:
        print("Chromium is not installed", file=sys.stderr)
        return 2
    browser = Chromium(program)
    try:
        with tempfile.TemporaryDirectory() as folder:
            page = write_page(make_law(legs), Path(folder) / "motion.html")
            print(f"page of {legs} legs: {page.stat().st_size / 1e6:.2f} MB")
            for width in (390, 1366):
                browser.open(page, width)
                script = {m["name"]: m["value"] for m in browser.send("Performance.getMetrics")["metrics"]}
                print(f"{width} px: start {1000 * script['ScriptDuration']:.0f} ms of script")
                for name, (mean, longest) in browser.evaluate(f"({MEASURE})({FRAMES})").items():
                    print(f"  {name}: {mean:.2f} ms a frame, {longest:.1f} ms the longest of {FRAMES}")
    finally:
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
