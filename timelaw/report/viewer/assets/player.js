// What a reader does: turns the view, moves in time, plays; and what is written beside the picture.

const TURN = Math.PI / 36; // of the view by a key
const STEEPEST = Math.PI / 2;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];
const LONGEST = 90; // seconds that a motion should take to look at

/** A number beside one of some size, to four digits of that, with a true minus sign and no minus before zero. */
function show(number, size) {
  const power = Math.floor(Math.log10(size));
  const plain = power > -5 && power < 6;
  const kept = Math.abs(number) < 1e-4 * size ? 0 : number;
  const text = plain ? kept.toFixed(Math.max(3 - power, 0)) : kept.toExponential(2);
  return text.replaceAll("-", "−");
}

/** The greatest |ω| at some times. */
function findFastest(law, times) {
  let most = Number.MIN_VALUE;
  for (const t of times) {
    law.moveTo(t);
    most = Math.max(most, Math.hypot(...law.rates[1]));
  }
  return most;
}

class Player {
  constructor(root, data) {
    this.root = root;
    this.find = (name) => root.querySelector(`[data-part="${name}"]`);
    this.law = new Law(data);
    this.trace = traceMotion(this.law);
    this.law.fastest = findFastest(this.law, this.trace.times);
    this.canvas = new Canvas(this.find("canvas"));
    const shape = data.shape ?? [1, 0.66, 0.4];
    this.scenes = { sphere: new Sphere(this.law, this.trace, shape) };
    if (data.travels) this.scenes.space = new Space(this.law, this.trace, shape);
    this.scene = this.scenes[data.travels ? "space" : "sphere"];
    this.time = 0;
    this.playing = false;
    this.makeBars();
    this.listen();
    this.seek(0);
    this.resize();
  }

  makeBars() {
    const list = this.find("bars"), model = this.find("bar");
    this.bars = this.law.limits.map((limit) => {
      const row = model.content.cloneNode(true).firstElementChild;
      const part = (name) => row.querySelector(`[data-bar="${name}"]`);
      part("label").textContent = limit.label;
      part("peak").style.left = `${100 * Math.min(limit.peak, 1)}%`;
      list.append(row);
      return { limit, fill: part("fill"), value: part("value"), peak: part("peak"), text: "" };
    });
  }

  listen() {
    const { canvas } = this, slider = this.find("time"), speed = this.find("speed");
    slider.max = this.law.duration;
    slider.addEventListener("input", () => this.seek(Number(slider.value)));
    this.find("play").addEventListener("click", () => this.play(!this.playing));
    this.find("back").addEventListener("click", () => this.step(-1));
    this.find("next").addEventListener("click", () => this.step(1));
    const usual = SPEEDS.find((s) => s >= 1 && this.law.duration / s <= LONGEST) ?? SPEEDS.at(-1);
    for (const s of SPEEDS.filter((s) => s <= 10 * usual && s >= usual / 10)) {
      speed.append(new Option(`${s} ×`, s, s === usual, s === usual));
    }
    const scene = this.find("scene");
    scene.addEventListener("change", () => this.choose(scene.value));
    canvas.element.addEventListener("keydown", (event) => this.key(event));
    this.listenToPointer(canvas.element);
    new ResizeObserver(() => this.resize()).observe(canvas.element);
    for (const medium of ["(prefers-color-scheme: dark)", "print"]) {
      matchMedia(medium).addEventListener("change", () => this.resize());
    }
    new MutationObserver(() => this.resize()).observe(document.documentElement, { attributes: true });
    new IntersectionObserver(([entry]) => entry.isIntersecting || this.play(false)).observe(this.root);
  }

  listenToPointer(element) {
    let last = null;
    element.addEventListener("pointerdown", (event) => {
      last = [event.clientX, event.clientY];
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (last === null) return;
      const scale = 1 / this.canvas.radius;
      this.turnView(-(event.clientX - last[0]) * scale, (event.clientY - last[1]) * scale);
      last = [event.clientX, event.clientY];
    });
    for (const name of ["pointerup", "pointercancel"]) element.addEventListener(name, () => (last = null));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns = { ArrowLeft: [TURN, 0], ArrowRight: [-TURN, 0], ArrowUp: [0, TURN], ArrowDown: [0, -TURN] };
    const acts = {
      " ": () => this.play(!this.playing),
      ",": () => this.step(-1),
      ".": () => this.step(1),
      Home: () => this.seek(0),
      End: () => this.seek(this.law.duration),
    };
    if (event.key in turns) this.turnView(...turns[event.key]);
    else if (event.key in acts) acts[event.key]();
    else return;
    event.preventDefault();
  }

  turnView(aside, up) {
    const { canvas } = this;
    canvas.azimuth += aside;
    canvas.elevation = Math.min(Math.max(canvas.elevation + up, -STEEPEST), STEEPEST);
    canvas.lookFrom();
    this.turned = true;
    this.draw();
  }

  choose(name) {
    this.scene = this.scenes[name];
    this.turned = true;
    this.draw();
  }

  /** To the node after this instant, or the one before it. */
  step(way) {
    const { times } = this.law, slack = 1e-9 * this.law.duration;
    const ahead = way > 0 ? times.find((t) => t > this.time + slack) : times.findLast((t) => t < this.time - slack);
    this.play(false);
    this.seek(ahead ?? (way > 0 ? this.law.duration : 0));
  }

  play(on) {
    if (on === this.playing) return;
    this.playing = on;
    if (on && this.time >= this.law.duration) this.seek(0);
    this.find("play").textContent = on ? "Pause" : "Play";
    if (!on) return;
    let last = null;
    const frame = (now) => {
      if (!this.playing) return;
      if (last !== null) this.seek(this.time + ((now - last) / 1000) * Number(this.find("speed").value));
      last = now;
      if (this.time >= this.law.duration) this.play(false);
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  seek(t) {
    this.time = Math.min(Math.max(t, 0), this.law.duration);
    this.law.moveTo(this.time);
    this.write();
    this.draw();
  }

  write() {
    const slider = this.find("time"), { law } = this;
    slider.value = this.time;
    const words = `${this.time.toFixed(2)} s of ${law.duration.toFixed(2)} s, ${law.name}`;
    slider.setAttribute("aria-valuetext", words);
    this.find("words").textContent = words;
    this.find("q").textContent = Array.from(law.q, (part) => show(part, 1)).join("  ");
    const degrees = 180 / Math.PI, fastest = law.fastest * degrees;
    this.find("omega").textContent = Array.from(law.rates[1], (w) => show(w * degrees, fastest)).join("  ");
    for (const bar of this.bars) this.writeBar(bar);
  }

  writeBar(bar) {
    const found = this.law.measure(bar.limit), { factor, unit } = bar.limit;
    const used = found === null ? 0 : found[0] / found[1];
    bar.fill.style.transform = `scaleX(${Math.min(used, 1)})`;
    const numbers = (found ?? []).map((part) => show(part * factor, found[1] * factor));
    const text = found === null ? "no limit here" : `${numbers.join(" of ")} ${unit}`;
    if (text !== bar.text) bar.value.textContent = bar.text = text;
  }

  resize() {
    this.canvas.fit();
    this.turned = true;
    for (const [k, name] of ["x", "y", "z"].entries()) {
      this.root.style.setProperty(`--axis-${name}`, this.canvas.colours.axes[k]);
    }
    this.root.style.setProperty("--axis-omega", this.canvas.colours.omega);
    this.draw();
  }

  draw() {
    const { canvas } = this, c = canvas.context;
    if (!canvas.size) return;
    c.setTransform(canvas.ratio, 0, 0, canvas.ratio, 0, 0);
    c.clearRect(0, 0, canvas.size, canvas.size);
    this.scene.draw(canvas, this.time, this.turned);
    this.turned = false;
  }
}

for (const root of document.querySelectorAll(".motion")) {
  root.player = new Player(root, JSON.parse(root.querySelector('[data-part="law"]').textContent));
  root.classList.add("ready");
}
