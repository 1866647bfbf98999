// node benchmarks/page_frames.mjs build/release/web/gracilis.wasm [METHOD...]: what a frame of the page's built-in hip
// costs the solver in WebAssembly, by each of its methods that is named (the first), flexed by 60 degrees and back.
import { readFileSync } from 'node:fs';

const [, , file, ...asked] = process.argv;
const STEP = 1.25 * Math.PI / 180, THERE = 48, TIMES = 2;
let program, seen;  // the view of the memory, until it grows: the clock is asked hundreds of times a step
const view = () => seen && seen.buffer === program.memory.buffer ? seen : seen = new DataView(program.memory.buffer);
const text = (at, length) => new TextDecoder().decode(new Uint8Array(program.memory.buffer, at, length));
const system = new Proxy({
  clock_time_get(clock, precision, at) {
    view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  },
}, { get: (known, name) => known[name] || (() => 52) });
const page = { fail(at, length) { throw new Error(text(at, length)); } };
program = (await WebAssembly.instantiate(readFileSync(file), { wasi_snapshot_preview1: system, page })).instance.exports;
program._initialize();
program.prepare();
const at = program.description(), bytes = new Uint8Array(program.memory.buffer, at);
const scene = JSON.parse(text(at, bytes.indexOf(0)));
const coordinates = program.malloc(8 * scene.coordinates.length), activations = program.malloc(8 * scene.muscles.length);

// ms of the processor, or of the clock where that is less: nothing else counts.
function frame(values) {
  new Float64Array(program.memory.buffer, coordinates, values.length).set(values);
  new Float64Array(program.memory.buffer, activations, scene.muscles.length).fill(0);
  const processor = process.cpuUsage(), clock = performance.now();
  program.advance(coordinates, activations);
  const { user, system: own } = process.cpuUsage(processor);
  return Math.min(performance.now() - clock, (user + own) / 1000);
}

console.log('| method | median, ms | fastest tenth, ms | first, ms |\n| --- | --- | --- | --- |');
for (const name of asked.length ? asked : [scene.methods[0].name]) {
  program.choose(scene.methods.findIndex(method => method.name === name));
  const values = scene.coordinates.map(coordinate => coordinate.capture), taken = [];
  for (let step = 0; step < 2 * THERE * TIMES; ++step) {
    values[0] += step % (2 * THERE) < THERE ? STEP : -STEP;
    taken.push(frame(values));
  }
  const sorted = taken.slice(THERE / 2).sort((a, b) => a - b), share = part => sorted[Math.floor(part * sorted.length)];
  console.log(`| ${name} | ${share(0.5).toFixed(1)} | ${share(0.1).toFixed(1)} | ${taken[0].toFixed(1)} |`);
}
