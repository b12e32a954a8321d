// The page around the worker: sliders to it, clips, curves and figures from it.
(function () {
  const find = (id) => document.getElementById(id);
  const text = (id) => find(id).textContent;
  const data = JSON.parse(text("data")), { Z } = data;
  const CLIP = { frames: 161, interval: 25e-6 }, RECENT = 10;  // points of the curves that the cards show
  const front = find("front"), strip = find("strip"), trace = find("trace"), follow = find("follow"), message = find("message");
  const index = Object.fromEntries(data.channels.map((name, i) => [name, i]));
  const range = { race: 0, pocket: 0, stress: 0, least: 0 };
  const { colours, readColours, prepare, drawFront, drawStrip } = bearingDrawing({ ...data, range, has: () => true });
  const worker = new Worker(URL.createObjectURL(new Blob([text("worker")], { type: "text/javascript" })));
  const clips = [];  // the one that is shown, and the next one
  let shown = 0, lastTick = 0, asked = false, running = true, curves = [];

  // ---- sliders and the scene ----
  const sliders = data.sliders.map((s) => ({ ...s, input: document.querySelector(`input[name="${s.name}"]`) }));
  const digits = (s) => Math.max(0, -Math.floor(Math.log10(s.step)));
  const si = (s) => Number(s.input.value) / s.factor;
  const shownUnit = (unit) => unit.replace("um", "µm").replace("deg", "°");
  function scene() {
    const line = (s) => `${s.name} = "${Number(s.input.value).toFixed(digits(s))} ${s.unit}"`;
    const parameters = [...sliders.filter((s) => !s.live).map(line), ...Object.entries(data.fixed).map(([name, value]) => `${name} = ${value}`),
      ...Object.entries(data.choices).map(([name, item]) => `${name} = "${item}"`)];
    find("scene").textContent = ['description = "From the page"', "", "[simulation]", "t_end = 0.4", "step = 1e-4", "", "[parameters]", ...parameters,
      "", "[inputs]", ...sliders.filter((s) => s.live).map(line)].join("\n") + "\n";
  }
  function label(s) {
    s.input.previousElementSibling.textContent = `${Number(s.input.value).toFixed(digits(s))} ${shownUnit(s.unit)}`;
    s.input.setAttribute("aria-valuetext", s.input.previousElementSibling.textContent);
  }
  function start() {
    message.hidden = true;
    curves = [];
    clips.length = 0;
    range.race = range.pocket = range.stress = 0;
    const values = { ...data.fixed, ...data.switches, ...Object.fromEntries(sliders.map((s) => [s.name, si(s)])) };
    const types = Object.fromEntries(sliders.map((s) => [s.name, "Real"]));
    asked = true;
    worker.postMessage({ start: { values, types }, clip: CLIP });
    showRunning(true);
  }
  function showRunning(on) {
    running = on;
    find("run").textContent = on ? "Pause" : "Go on";
    find("run").setAttribute("aria-pressed", String(on));
  }
  for (const s of sliders) {
    s.input.addEventListener("input", () => {
      label(s);
      scene();
      if (s.live) worker.postMessage({ inputs: { [s.name]: si(s) } });
      if (s.tuned) worker.postMessage({ parameters: { [s.name]: si(s) } });
    });
    if (!s.live && !s.tuned) s.input.addEventListener("change", start);
  }
  find("run").addEventListener("click", () => {
    showRunning(!running);
    worker.postMessage({ run: running });
  });
  find("again").addEventListener("click", start);
  find("copy").addEventListener("click", async () => {
    getSelection().selectAllChildren(find("scene"));  // for a browser that refuses the clipboard
    try {
      await navigator.clipboard.writeText(text("scene"));
      find("copy").textContent = "Copied";
    } catch {
      find("copy").textContent = "Marked: copy with Ctrl-C";
    }
    setTimeout(() => (find("copy").textContent = "Copy"), 2000);
  });

  // ---- the motion ----
  // Values between two frames of a clip, by the names that the drawing uses.
  function reader(clip, t) {
    const last = clip.time.length - 1, at = Math.min(last, Math.max(0, (t - clip.time[0]) / CLIP.interval)), i = Math.floor(at), next = Math.min(i + 1, last), w = at - i;
    const mix = (a, b) => a + w * (b - a);
    const raw = (name) => mix(clip.rows[i][index[name]], clip.rows[next][index[name]]);
    const psi = () => 0.5 * (raw("half_0.psi") + raw("half_1.psi"));
    const element = (name) => /^(lag|x|r|Q_i|Q_e|Q_c|stress)(\d+)$/.exec(name);
    return {
      angle: (name) => (name === "psi" ? psi() : mix(clip.shaft[i], clip.shaft[next])),
      value: (name) => {
        const [, what, j] = element(name) || [];
        if (name === "twist") return raw("half_1.psi") - raw("half_0.psi");
        if (what === "lag") return raw(`ball[${j}].psi`) - psi() - (2 * Math.PI * (j - 1)) / Z;
        return raw(what ? `ball[${j}].${what}` : name);
      },
      peak: (name) => {
        const [, , k] = element(name) || [];
        return clip.rows[w > 0 ? next : i][index[k ? `rivet[${k}].sigma_head_peak` : name]];
      },
    };
  }
  // Arrows and colours grow with a clip at once and shrink slowly.
  function measure(clip) {
    const rows = clip.rows.slice(1);  // the first one holds the peaks of a longer step
    const most = (pattern) => Math.max(...Object.keys(index).filter((name) => pattern.test(name)).map((name) => Math.max(...rows.map((row) => row[index[name]]))));
    const grow = (name, value) => (range[name] = Math.max(value, 0.8 * range[name]));
    grow("race", most(/\.Q_[ie]$/));
    grow("pocket", most(/\.Q_c$/));
    grow("stress", most(/sigma_head_peak$/));
    range.least = Math.min(...rows.map((row) => Math.min(...data.channels.filter((name) => name.endsWith("sigma_head_peak")).map((name) => row[index[name]]))));
  }
  function tick(stamp) {
    const step = (1e-3 * Math.min(100, stamp - lastTick)) / Number(find("slower").value);
    lastTick = stamp;
    requestAnimationFrame(tick);
    if (!clips.length || !front.clientWidth) return;
    const end = clips[0].time[clips[0].time.length - 1];
    if (running) shown += step;
    if (shown >= end && clips.length > 1) {
      clips.shift();
      measure(clips[0]);
      shown = clips[0].time[0];
    }
    if (!asked && running && clips.length < 2 && end - shown < 0.3 / Number(find("slower").value)) {  // a clip that is 0.3 s old when shown
      asked = true;
      worker.postMessage({ clip: CLIP });
    }
    shown = Math.min(shown, clips[0].time[clips[0].time.length - 1]);
    const see = reader(clips[0], shown);
    drawFront(front, see, follow.checked);
    drawStrip(strip, see);
    find("readout").textContent = `shown: ${(1e3 * shown).toFixed(2)} ms  ·  cage turn ${(see.angle("psi") / (2 * Math.PI)).toFixed(2)}  ·  head ${(1e-6 * see.peak("rivet.sigma_head_max")).toFixed(0)} MPa  ·  pocket ${see.peak("cage.F_pocket_peak").toFixed(1)} N`;
  }

  // ---- curves and figures ----
  const largest = (row, from, to) => Math.max(...row.slice(from, to));
  const KINDS = [["head", (row) => 1e-6 * largest(row, 0, Z), "MPa", "head stress, worst rivet"], ["force", (row) => row[2 * Z], "N", "pocket force"]];
  function drawTrace() {
    const { g, width, height } = prepare(trace), rows = curves.slice(-Math.max(200, Math.floor(2 * width))), half = height / KINDS.length;
    if (rows.length < 2) return;
    g.font = "11px system-ui, sans-serif";
    KINDS.forEach(([colour, of, unit, what], n) => {
      const values = rows.map(([, row]) => of(row)), high = Math.max(...values) || 1;
      g.strokeStyle = colours[colour];
      g.lineWidth = 1;
      g.beginPath();
      values.forEach((v, i) => g.lineTo((i / (rows.length - 1)) * width, (n + 1) * half - 2 - (v / high) * (half - 18)));
      g.stroke();
      g.fillStyle = colours.ink;
      g.fillText(`${what}, full height ${high.toPrecision(3)} ${unit}, ${(1e3 * rows[0][0]).toFixed(0)} to ${(1e3 * rows[rows.length - 1][0]).toFixed(0)} ms`, 2, n * half + 11);
    });
  }
  function show({ curves: fresh, figures, time, rate }) {
    fresh.time.forEach((t, i) => curves.push([t, fresh.rows[i]]));
    curves = curves.slice(-4000);
    const recent = curves.slice(-RECENT).map(([, row]) => row), value = Object.fromEntries(data.figures.map((name, i) => [name, figures[i]]));
    if (recent.length) {
      find("head").textContent = `${Math.max(...recent.map(KINDS[0][1])).toFixed(0)} MPa`;
      find("pocket").textContent = `${Math.max(...recent.map(KINDS[1][1])).toFixed(1)} N`;
    }
    find("slip").textContent = `${(100 * value["cage.slip_ratio"]).toFixed(2)} %`;
    find("time").textContent = `${time.toFixed(3)} s`;
    find("time").dataset.rate = rate;
    find("rate").textContent = `${rate.toPrecision(2)} s in a second of yours`;
    find("covered").textContent = value["stat.time"] > 0 ? `Over ${(1e3 * value["stat.time"]).toFixed(0)} ms` : "Nothing yet";
    if (value["stat.time"] > 0) {
      for (const cell of document.querySelectorAll("[data-figure]")) {
        const number = (cell.dataset.unit === "MPa" ? 1e-6 : 1) * value[cell.dataset.figure];
        cell.textContent = number >= 1000 ? number.toFixed(0) : number.toPrecision(3);
      }
    }
    drawTrace();
  }
  worker.onmessage = ({ data: said }) => {
    if (said.created) start();
    if (said.clip) {
      asked = false;
      clips.push(said.clip);
      if (clips.length === 1) {
        measure(said.clip);
        shown = said.clip.time[0];
        document.body.dataset.ready = "yes";
      }
    }
    if (said.figures) show(said);
    if (said.text || said.stopped) {
      message.hidden = false;
      message.textContent = [said.stopped, said.text || message.textContent].filter(Boolean).join(" ");
    }
    if (said.stopped) showRunning(false);
  };
  worker.onerror = (event) => {
    message.hidden = false;
    message.textContent = `The core does not run here (it needs a browser of 2023 or later with WebAssembly SIMD): ${event.message}`;
  };

  readColours();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", readColours);
  sliders.forEach(label);
  scene();
  const core = Uint8Array.from(atob(text("core")), (c) => c.charCodeAt(0)).buffer;
  worker.postMessage({ create: { core, channels: data.channels, peaks: data.peaks, figures: data.figures } });
  requestAnimationFrame(tick);
})();
