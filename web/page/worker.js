// Runs the program in a worker of its own, so that the page never waits for it. Told where sliders stand, it goes there
// in steps that methods take, and sends every step's shapes.
const TURN = 1.25 * Math.PI / 180, SHIFT = 0.002, ACTIVATION = 0.05, STEP = 1000 / 60;
const ARMS_INTERVAL = 400;  // ms; moment arms of strings take longer than the strings
let module, own, program, scene, reached, wanted, asked, coordinates, activations, places, pulled, chosen = 0, armsAt = 0;
let ready = false, running = false;  // whether the program can be asked, and whether it is going somewhere

const text = (at, length) => new TextDecoder().decode(new Uint8Array(program.memory.buffer, at, length));

// What the C++ library asks a system for; it opens no files.
function system() {
  let seen;  // of the memory, until it grows: the clock is asked hundreds of times a step
  const view = () => seen && seen.buffer === program.memory.buffer ? seen : seen = new DataView(program.memory.buffer);
  return new Proxy({
    clock_time_get(clock, precision, at) {
      view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    fd_write(file, parts, count, written) {
      let bytes = 0;
      for (let i = 0; i < count; ++i) bytes += view().getUint32(parts + 8 * i + 4, true);
      view().setUint32(written, bytes, true);
      return 0;
    },
    proc_exit(code) { throw new Error(`the program ended with ${code}`); },
  }, {get: (known, name) => known[name] || (() => 52)});  // 52: there is no such call
}

async function start() {
  const imports = {wasi_snapshot_preview1: system(), page: {fail(at, length) { throw new Error(text(at, length)); }}};
  program = (await WebAssembly.instantiate(module, imports)).exports;
  program._initialize();
  if (own) prepareOwn();
  else program.prepare();
  describe();
  reached = {coordinates: scene.coordinates.map(each => each.capture), activations: scene.muscles.map(() => 0)};
  wanted = wanted || JSON.parse(JSON.stringify(reached));
  coordinates = program.malloc(8 * scene.coordinates.length);
  activations = program.malloc(8 * scene.muscles.length);
  places = program.malloc(8 * 9);
  pulled = program.malloc(8 * scene.coordinates.length);
  ready = true;
}

// The scene that the page brings along.
function prepareOwn() {
  const at = program.malloc(own.length);
  new Uint8Array(program.memory.buffer, at, own.length).set(own);
  program.prepare_scene(at, own.length);
}

function describe() {
  const at = program.description(), bytes = new Uint8Array(program.memory.buffer, at);
  scene = JSON.parse(text(at, bytes.indexOf(0)));
}

const copy = (Type, at, count) => new Type(program.memory.buffer, at, count).slice();

function constants() {
  const surface = each => ({name: each.name, points: copy(Float32Array, each.points, 3 * each.vertices),
                            faces: copy(Uint32Array, each.faces, 3 * each.faceCount)});
  postMessage({kind: 'scene', name: scene.name, axes: scene.axes, methods: scene.methods, coordinates: scene.coordinates,
               bones: scene.bones.map(each => ({...surface(each), body: each.body})),
               brightness: copy(Uint8Array, scene.brightness, 512),
               muscles: scene.muscles.map(each => ({...surface(each), color: each.color, belly: each.belly, tendon: each.tendon,
                                                    tendonShares: copy(Uint8Array, each.tendonShares, each.vertices),
                                                    stripes: copy(Float32Array, each.stripes, each.vertices)}))});
}

function show(milliseconds, arms = true) {
  program.show(arms ? 1 : 0);
  if (arms) armsAt = performance.now();
  describe();  // addresses change with the fibers' number
  const muscles = scene.muscles.map(each => {
    const offsets = copy(Uint32Array, each.fiberOffsets, each.fiberCount + 1);
    return {points: copy(Float32Array, each.points, 3 * each.vertices), offsets,
            fibers: copy(Float32Array, each.fibers, 3 * offsets[each.fiberCount]),
            strains: copy(Float32Array, each.strains, each.fiberCount),
            facts: copy(Float64Array, each.facts, 2 + scene.coordinates.length)};
  });
  postMessage({kind: 'frame', milliseconds, muscles, method: chosen,
               bodies: copy(Float32Array, scene.bodies, 12 * scene.bodyCount),
               coordinates: reached.coordinates.slice(), activations: reached.activations.slice()},
              muscles.flatMap(each => [each.points.buffer, each.fibers.buffer]));
}

function choose(method) {
  postMessage({kind: 'status', text: `preparing ${scene.methods[method].name}`});
  chosen = method;
  program.choose(method);
  reached = {coordinates: scene.coordinates.map(each => each.capture), activations: scene.muscles.map(() => 0)};
  show(null);
  postMessage({kind: 'status', text: 'ready'});
}

// One step of all values towards where they are wanted; false when they are there.
function approach() {
  let moved = false;
  const move = (values, targets, most) => values.forEach((value, i) => {
    if (value === targets[i]) return;
    moved = true;
    values[i] = value + Math.min(Math.max(targets[i] - value, -most(i)), most(i));
  });
  move(reached.coordinates, wanted.coordinates, c => scene.coordinates[c].translation ? SHIFT : TURN);
  move(reached.activations, wanted.activations, () => ACTIVATION);
  return moved;
}

function step() {
  new Float64Array(program.memory.buffer, coordinates, reached.coordinates.length).set(reached.coordinates);
  new Float64Array(program.memory.buffer, activations, reached.activations.length).set(reached.activations);
  const began = performance.now();
  program.advance(coordinates, activations);
  const milliseconds = performance.now() - began, there = JSON.stringify(reached) === JSON.stringify(wanted);
  show(milliseconds, there || performance.now() - armsAt > ARMS_INTERVAL);
}

// A bone's point (at rest) is wanted at `target`, seen along `looking`: the page is told what that means for sliders.
function follow() {
  if (!asked) return;
  const {bone, point, target, looking} = asked;
  asked = null;
  new Float64Array(program.memory.buffer, places, 9).set([...point, ...target, ...looking]);
  const values = new Float64Array(program.memory.buffer, pulled, wanted.coordinates.length);
  values.set(wanted.coordinates);
  if (!program.pull(bone, places, pulled)) return;
  wanted.coordinates = [...new Float64Array(program.memory.buffer, pulled, wanted.coordinates.length)];
  postMessage({kind: 'aim', coordinates: wanted.coordinates});
}

async function run() {
  if (running || !ready) return;
  running = true;
  try {
    for (follow(); approach(); follow()) {
      const began = performance.now();
      step();
      // Messages come in between; and no faster than 60 steps a second, which is a time step.
      await new Promise(done => setTimeout(done, Math.max(0, STEP - (performance.now() - began))));
    }
    postMessage({kind: 'status', text: 'ready'});
    running = false;
  } catch (error) {
    await recover(error);
    running = false;
    await run();  // to where it was aimed at meanwhile
  }
}

// After a failure nothing in the program's memory can be relied on.
async function recover(error) {
  postMessage({kind: 'failure', text: error.message});
  ready = false;
  wanted = asked = null;
  await start();
  choose(chosen);
}

// What a new program does not mend either: whoever asks for a method next begins with another one.
function giveUp(error) {
  ready = running = false;
  postMessage({kind: 'failure', text: error.message, final: true});
}

const tasks = {
  async begin({bytes, scene: brought, method}) {
    module = await WebAssembly.compile(bytes);
    own = brought && new Uint8Array(brought);
    postMessage({kind: 'status', text: own ? 'reading the scene' : 'making the hip'});
    await start();
    constants();
    await tasks.choose({method});
  },
  async choose({method}) {
    while (running) await new Promise(done => setTimeout(done, 5));
    running = true;
    try {
      if (!ready) await start();
      choose(method);
    } catch (error) {
      chosen = 0;
      await recover(error);
    }
    running = false;
    await run();
  },
  async aim(values) {
    wanted = {coordinates: values.coordinates, activations: values.activations};
    await run();
  },
  async pull(what) {
    if (!ready) return;
    asked = what;
    await run();
  },
  async reset() {
    wanted = {coordinates: scene.coordinates.map(each => each.capture), activations: scene.muscles.map(() => 0)};
    await tasks.choose({method: chosen});
  },
};
onmessage = ({data}) => tasks[data.task](data).catch(giveUp);
