// Plays the frames of animation.py: the bearing and the unrolled cage (drawing.js), and the largest stress over time.
"use strict";
(function () {
  const root = document.getElementById("animation");
  if (!root) return;
  const film = JSON.parse(document.getElementById("frames").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const time = new Float32Array(bytes(film.time));
  const turned = Object.fromEntries(Object.entries(film.turned).map(([name, text]) => [name, new Float32Array(bytes(text))]));
  const channels = Object.fromEntries(Object.entries(film.channels).map(([name, c]) => [name, { first: c.first, step: c.step, n: new Int16Array(bytes(c.data)) }]));
  const { Z } = film, last = time.length - 1, end = time[last];
  const find = (id) => root.querySelector("#" + id);
  const front = find("front"), strip = find("strip"), trace = find("trace"), slider = find("when"), button = find("play"), speed = find("speed");
  const follow = find("follow"), readout = find("readout");
  // Smallest and largest value of channels after settling: the first shocks shall not set the scales.
  const settled = Math.min(time.findIndex((t) => t >= film.settle) >>> 0, time.length - 2);
  function range(names) {
    let low = Infinity, high = -Infinity;
    for (const c of names.map((name) => channels[name]).filter(Boolean)) {
      for (let i = settled; i < time.length; i++) {
        const v = c.first + c.step * c.n[i];
        low = Math.min(low, v);
        high = Math.max(high, v);
      }
    }
    return { low, high };
  }
  const ofBalls = (...names) => Array.from({ length: Z }, (_, j) => names.map((name) => name + (j + 1))).flat();
  const stress = range(ofBalls("stress"));
  const ranges = { race: range(ofBalls("Q_i", "Q_e")).high, pocket: range(ofBalls("Q_c")).high, stress: stress.high, least: stress.low };
  const { colours, readColours, prepare, drawFront, drawStrip } = bearingDrawing({ ...film, range: ranges, has: (name) => name in channels });
  let now = 0, playing = false, lastTick = 0;

  // Index and weight of the frame before t; angles go on in straight lines between frames, as do all other channels but peaks.
  function place(t) {
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (time[middle] <= t) low = middle; else high = middle;
    }
    return { i: low, w: Math.min(1, Math.max(0, (t - time[low]) / (time[high] - time[low] || 1))) };
  }
  const gone = film.gone || {};
  function reader(at) {
    const mix = (a, b) => a + at.w * (b - a), next = Math.min(at.i + 1, last);
    return {
      gone: (k) => k in gone && now >= gone[k],
      angle: (name) => mix(turned[name][at.i], turned[name][next]),
      value: (name) => {
        const c = channels[name];
        return c ? c.first + c.step * mix(c.n[at.i], c.n[next]) : 0;
      },
      peak: (name) => {
        const c = channels[name];
        return c ? c.first + c.step * c.n[at.w > 0 ? next : at.i] : 0;
      },
    };
  }

  // Largest head stress of all rivets over time, with the present time; kept as a picture, as only the cursor moves.
  const over = document.createElement("canvas");
  function traceCurve(name, top, height, width, g, colour) {
    const c = channels[name];
    if (!c) return;
    const peak = range([name]).high, up = (v) => Math.min(1, Math.max(0, v / (peak || 1))) * height;
    g.strokeStyle = colour;
    g.lineWidth = 1;
    g.beginPath();
    for (let x = 0; x < width; x++) {
      const from = place((x / width) * end).i, to = place(((x + 1) / width) * end).i;
      let high = -Infinity, low = Infinity;
      for (let i = from; i <= to; i++) {
        const v = c.first + c.step * c.n[i];
        high = Math.max(high, v);
        low = Math.min(low, v);
      }
      g.moveTo(x + 0.5, top + height - up(low));
      g.lineTo(x + 0.5, top + height - up(high) - 0.5);
    }
    g.stroke();
    return peak;
  }
  function drawTrace(fresh) {
    const { g, width, height } = prepare(trace);
    if (fresh || over.width !== trace.width) {
      over.width = trace.width;
      over.height = trace.height;
      const o = over.getContext("2d"), ratio = trace.width / width, half = height / 2;
      o.scale(ratio, ratio);
      o.font = "11px system-ui, sans-serif";
      const rows = [["rivet.sigma_head_max", "head", 1e-6, "MPa largest head stress"], ["cage.F_pocket_peak", "force", 1, "N largest pocket force"]];
      rows.forEach(([name, colour, factor, label], i) => {
        const peak = traceCurve(name, i * half + 14, half - 16, width, o, colours[colour]);
        if (peak === undefined) return;
        o.fillStyle = colours.ink;
        o.fillText(`${(factor * peak).toPrecision(3)} ${label}`, 2, i * half + 10);
      });
    }
    g.drawImage(over, 0, 0, width, height);
    const x = (now / end) * width;
    g.strokeStyle = colours.ink;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(x, 0);
    g.lineTo(x, height);
    g.stroke();
  }

  function draw(fresh) {
    if (!front.clientWidth) return;
    const at = place(now), see = reader(at);
    drawFront(front, see, follow.checked);
    drawStrip(strip, see);
    drawTrace(fresh);
    if (document.activeElement !== slider || playing) slider.value = now;
    const figures = [`${(1e3 * now).toFixed(2)} ms`, `cage turn ${(see.angle("psi") / (2 * Math.PI)).toFixed(2)}`];
    if (channels["rivet.sigma_head_max"]) figures.push(`head ${(1e-6 * see.peak("rivet.sigma_head_max")).toFixed(0)} MPa`);
    if (channels["cage.F_pocket_peak"]) figures.push(`pocket ${see.peak("cage.F_pocket_peak").toFixed(1)} N`);
    readout.textContent = figures.join("  ·  ");
    slider.setAttribute("aria-valuetext", figures[0]);
  }
  function tick(stamp) {
    if (!playing) return;
    now += (Math.min(100, stamp - lastTick) * 1e-3) / Number(speed.value);
    lastTick = stamp;
    if (now >= end) now = 0;
    draw();
    requestAnimationFrame(tick);
  }
  function play(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", String(on));
    if (on) {
      lastTick = performance.now();
      requestAnimationFrame(tick);
    }
  }
  function redraw() {
    readColours();
    draw(true);
  }
  slider.max = end;
  slider.step = end / 10000;
  now = Math.min(film.settle, 0.5 * end);
  slider.value = now;
  slider.addEventListener("input", () => { now = Number(slider.value); play(false); draw(); });
  button.addEventListener("click", () => play(!playing));
  follow.addEventListener("change", () => draw());
  const scrub = (event) => {
    if (event.type === "pointermove" && !event.buttons) return;
    const box = trace.getBoundingClientRect();
    now = end * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    play(false);
    draw();
    slider.value = now;
  };
  trace.addEventListener("pointerdown", scrub);
  trace.addEventListener("pointermove", scrub);
  new ResizeObserver(redraw).observe(front);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  const theme = (name) => () => { document.documentElement.dataset.theme = name; redraw(); };
  addEventListener("beforeprint", theme("light"));
  addEventListener("afterprint", theme(""));
  redraw();
  root.dataset.ready = "yes";
})();
