// Runs the core (core.c, compiled to WebAssembly) beside the page, as fast as it goes, in steps of STEP; on demand a clip of the motion in finer steps.
//
// To the worker: {create: {core, channels, peaks, figures}}, names of variables by element ("ball[3].Q_i") for clips, curves and the table;
//   {start: {values, types}}, values of all parameters and inputs that are not start values; {inputs: {name: value}} to which inputs go within RAMP;
//   {parameters: {name: value}}, tunable ones, in force from the next step on;
//   {clip: {frames, interval}}; {run: true or false}.
// To the page: {created}, {started}, {clip: {time, shaft, rows}}, {curves: {time, rows}, figures, time, rate}, {text} for messages, {stopped} at a step that failed.
"use strict";
const STEP = 1e-4, BIN = 10, RAMP = 0.01, SHARE = 30;  // s between communication points, steps in a point of a curve, s, ms of work between messages
let core, memory, wanted, ramps = {}, running = false, waiting = false, alive = false, clip = null, shaft = 0, begun = 0;

// What the C library asks of a system: a clock, and nothing else.
const system = new Proxy({}, {
  get: (_, name) => (...args) => {
    if (name !== "clock_time_get") return 52;  // no such function
    new DataView(core.memory.buffer).setBigUint64(args[2], BigInt(Math.round(1e6 * performance.now())), true);
    return 0;
  },
});

function read(address) {
  const bytes = new Uint8Array(core.memory.buffer);
  return new TextDecoder().decode(bytes.slice(address, bytes.indexOf(0, address)));
}
// Address and group of a variable or of one of its elements.
function place(name, order = 0) {
  const [, before, number, after] = /^([^[]*)(?:\[(\d+)\](.*))?$/.exec(name);
  for (const letter of number ? ["j", "k"] : [""]) {
    const row = number ? `${before}[${letter}]${after}` : before;
    new Uint8Array(core.memory.buffer).set(new TextEncoder().encode(row + "\0"), core.page_name());
    const address = core.page_address(order);
    if (address) return { name, address: address + (number ? 8 * (Number(number) - 1) : 0), group: core.page_group() };
  }
  throw new Error(`the core has no variable ${name}`);
}
const view = () => new DataView(core.memory.buffer);
const value = (at) => view().getFloat64(at.address, true);
const update = (places) => new Set(places.map((at) => at.group)).forEach((group) => core.page_update(group));
function values(places) {
  update(places);
  const numbers = view();
  return places.map((at) => numbers.getFloat64(at.address, true));
}
function tell() {
  const text = read(core.page_messages());
  if (!text) return;
  view().setUint8(core.page_messages(), 0);
  postMessage({ text });
}

function create({ core: bytes, ...names }) {
  core = new WebAssembly.Instance(new WebAssembly.Module(bytes), { wasi_snapshot_preview1: system }).exports;
  core._initialize();
  if (!core.page_create()) throw new Error("out of memory");
  wanted = Object.fromEntries(Object.entries(names).map(([key, list]) => [key, list.map((name) => place(name))]));
  wanted.omega = place("shaft.omega");
  postMessage({ created: true });
}
function start({ values: given, types }) {
  core.page_reset();
  for (const [name, number] of Object.entries(given)) {
    const at = place(name);
    if (types[name] === "Real") view().setFloat64(at.address, number, true);
    else view().setInt32(at.address, number, true);
  }
  ramps = {};
  shaft = begun = 0;
  const status = core.page_initialize();
  tell();
  alive = running = status <= 1;
  postMessage(running ? { started: true } : { stopped: "The core refuses these values." });
}
function aim(inputs) {
  for (const [name, goal] of Object.entries(inputs)) ramps[name] = { at: place(name), slope: place(name, 1), goal, left: RAMP };
}

function tune(parameters) {
  for (const [name, number] of Object.entries(parameters)) view().setFloat64(place(name).address, number, true);
}

// One communication step; inputs on their way go in a straight line.
function step(h) {
  for (const [name, ramp] of Object.entries(ramps)) {
    const part = Math.min(1, h / ramp.left);
    view().setFloat64(ramp.slope.address, ((ramp.goal - value(ramp.at)) * part) / h, true);
    ramp.left -= h;
    if (part === 1) delete ramps[name];
  }
  const before = value(wanted.omega);
  const status = core.page_step(begun + h);
  if (status > 1) {
    alive = running = false;
    tell();
    postMessage({ stopped: "The core cannot go on." });
    return false;
  }
  begun += h;
  shaft += 0.5 * h * (before + value(wanted.omega));
  return true;
}
function record({ frames, interval }) {
  const time = [begun], turned = [shaft], rows = [values(wanted.channels)];
  while (rows.length < frames && step(interval)) {
    time.push(begun);
    turned.push(shaft);
    rows.push(values(wanted.channels));
  }
  return { time, shaft: turned, rows };
}
function schedule() {
  if (!running || waiting) return;
  waiting = true;
  setTimeout(work, 0);
}
function work() {
  waiting = false;
  if (!running) return;
  if (clip) {
    postMessage({ clip: record(clip) });
    clip = null;
  }
  const first = performance.now(), from = begun, time = [], rows = [];
  while (running && performance.now() - first < SHARE) {
    let most = null;
    for (let i = 0; i < BIN && step(STEP); i++) {
      const now = values(wanted.peaks);
      most = most ? most.map((x, n) => Math.max(x, now[n])) : now;
    }
    if (!most) break;
    time.push(begun);
    rows.push(most);
  }
  tell();
  postMessage({ curves: { time, rows }, figures: values(wanted.figures), time: begun, rate: (1e3 * (begun - from)) / (performance.now() - first) });
  schedule();
}

onmessage = ({ data }) => {
  try {
    if (data.create) create(data.create);
    if (data.inputs) aim(data.inputs);
    if (data.parameters) tune(data.parameters);
    if (data.clip) clip = data.clip;
    if (data.start) start(data.start);
    if (data.run !== undefined) running = data.run && alive;
    schedule();
  } catch (error) {
    alive = running = false;
    postMessage({ stopped: error.message });
  }
};
