// Puts the page together: one state, what the worker sends, and everything that follows them.
const element = id => document.getElementById(id);
// Shares of the subject's directions: anterior, superior, right.
const DIRECTIONS = {front: [1, 0, 0], right: [0, 0, 1], back: [-1, 0, 0], left: [0, 0, -1], 'front right': [0.75, 0.15, 0.7]};
const PLOT_INTERVAL = 150;  // ms; drawing them costs more than what is new

// A scene that `gracilis report --live` put into the page, or nothing: the built-in hip.
const ownScene = element('scene').textContent.trim() && bytesOf('scene');

const page = {
  runCount: 1,
  state: {visible: new Set(), colorBy: 'natural', bones: true, fibers: false, wireframe: false, xAxis: 0, frame: 0},
  frame: null,          // the last one
  charts: [],
  milliseconds: [],     // of the last steps
  failures: 0,

  // What a Chart asks for.
  frameOf(run, frame) { return frame; },
  xOf() { return this.places; },
  xLabel() {
    if (this.state.xAxis < 0) return 'step';
    const coordinate = this.scene.coordinates[this.state.xAxis];
    return `${spoken(coordinate.name)} (${unitOf(coordinate).mark.trim()})`;
  },
  poseText(frame) { return this.textOf(this.history.frames[frame].coordinates); },
  textOf(coordinates) {
    return coordinates.map((value, c) => `${spoken(this.scene.coordinates[c].name)} ${this.valueText(c, value)}`).join(', ');
  },
  valueText(c, value) {
    const unit = unitOf(this.scene.coordinates[c]);
    return `${shownNumber(Number((value * unit.factor).toFixed(1)))}${unit.mark}`;
  },
  setSlider(c, value) { this.coordinates[c].slider.value = value * unitOf(this.scene.coordinates[c]).factor; },
  goTo(frame) {
    const at = this.history.frames[frame];
    if (at) this.aimAt(at.coordinates, at.activations);
  },

  send(task, what = {}) { this.worker.postMessage({task, ...what}); },
  wanted() {
    const values = list => list.map(({slider}) => Number(slider.value));
    return {coordinates: values(this.coordinates).map((value, c) => value / unitOf(this.scene.coordinates[c]).factor),
            activations: values(this.muscles).map(value => value / 100)};
  },
  aim() { this.send('aim', this.wanted()); },
  aimAt(coordinates, activations) {
    this.pause();
    coordinates.forEach((value, c) => this.setSlider(c, value));
    activations.forEach((value, m) => { this.muscles[m].slider.value = value * 100; });
    this.aim();
  },
  tell(text, failed = false) {
    element('status').textContent = text;
    element('status').classList.toggle('failed', failed);
  },

  pause() {
    this.playing = false;
    element('play').setAttribute('aria-pressed', 'false');
  },
  play() {
    this.playing = true;
    element('play').setAttribute('aria-pressed', 'true');
    this.swing();
  },
  // The first coordinate as far as it goes or to 90, and back again.
  swing() {
    if (!this.playing) return;
    const {slider} = this.coordinates[0], most = Math.min(90, Number(slider.max));
    const low = Math.max(most > 0 ? 0 : -90, Number(slider.min));
    slider.value = Number(slider.value) < most ? most : low;
    this.aim();
  },
};

// A row of a list of sliders: what it is called, the slider, and what is said of it.
function addSlider(list, id, name, attributes, unit, explain) {
  const row = make('div', '', {class: 'row'}), label = make('label', name, {for: id});
  const slider = make('input', '', {type: 'range', id, ...attributes});
  const output = make('output', '', {for: id, 'aria-live': 'off'});  // the slider says it; numbers change with every frame
  row.append(label, slider, output);
  list.append(row);
  const say = () => slider.setAttribute('aria-valuetext', `${shownNumber(Number(slider.value))} ${unit}`);
  slider.addEventListener('input', () => { say(); page.pause(); page.aim(); });
  say();
  return {slider, output, label, say, explain};
}

function addChoices(select, choices) {
  for (const [value, label] of choices) select.append(make('option', label, {value}));
}

function buildControls({coordinates, muscles, methods}) {
  page.coordinates = coordinates.map(coordinate => {
    const {factor, name: unit} = unitOf(coordinate), step = 0.5, rounded = value => Number(value.toFixed(6));
    const begin = rounded(factor * coordinate.capture);
    // Steps are counted from the capture pose, which the slider can come back to.
    const bound = value => rounded(begin + step * Math.trunc(rounded((factor * value - begin) / step)));
    const row = addSlider(element('coordinates'), coordinate.name, spoken(coordinate.name),
                          {min: bound(coordinate.low), max: bound(coordinate.high), step, value: begin}, unit);
    row.slider.addEventListener('input', () => { if (!page.axisIsChosen) plotAgainst(coordinates.indexOf(coordinate)); });
    return row;
  });
  page.muscles = muscles.map(({name, color}) => {
    const row = addSlider(element('muscles'), name, '', {min: 0, max: 100, step: 1, value: 0, 'aria-label': `Activation of ${spoken(name)}`},
                          '% active');
    const shown = make('input', '', {type: 'checkbox', checked: '', 'aria-label': `Show ${spoken(name)}`});
    shown.addEventListener('change', () => {
      page.state.visible[shown.checked ? 'add' : 'delete'](name);
      drawEverything();
    });
    const swatch = make('span', '', {class: 'swatch'});
    swatch.style.background = `rgb(${color.map(part => Math.round(255 * part))})`;
    row.label.append(swatch, spoken(name));
    row.label.before(shown);
    const head = make('span');
    head.append(shown, row.label);
    row.slider.before(head);
    return row;
  });
  addChoices(element('method'), methods.map(({name}, i) => [i, name]));
  addChoices(element('color-by'), Object.entries(SURFACE_COLORS));
  addChoices(element('x-axis'), [...coordinates.map(({name}, c) => [c, spoken(name)]), [-1, 'step']]);
  for (const [name, direction] of Object.entries(DIRECTIONS)) {
    const button = make('button', name, {type: 'button'});
    button.addEventListener('click', () => page.stage.lookFrom(inScene(direction)));
    element('views').append(button, ' ');
  }
}

// A direction of the subject's in the scene.
function inScene([anterior, superior, right]) {
  const axes = page.scene.axes, sum = new THREE.Vector3();
  for (const [axis, share] of [[axes.anterior, anterior], [axes.superior, superior], [axes.right, right]])
    sum.addScaledVector(new THREE.Vector3(...axis), share);
  return sum;
}

// Of a scene that the page brings along: what it is called.
function tellOwn({name, muscles}) {
  document.title = `${name} · Gracilis`;
  document.querySelector('h1').textContent = name;
  element('subtitle').textContent =
    `${muscles.length} muscle${muscles.length === 1 ? '' : 's'}, solved in this page as you move the bones. Nothing is loaded or sent.`;
}

function buildCharts({muscles}) {
  const css = color => `rgb(${color.map(part => Math.round(255 * part))})`;
  const lines = () => muscles.map(({name, color}) => ({name: spoken(name), muscle: name, color: css(color), dash: '', run: 0,
                                                        x: [], values: []}));
  for (const title of ['Fiber length', 'Moment arm']) {
    const chart = new Chart({title, unit: 'mm', limits: []}, lines(), page);
    page.charts.push(chart);
    element('plots').append(chart.element);
  }
}

function drawPlots() {
  page.plotted = performance.now();
  page.waiting = false;
  if (page.history.frames.length === 0) return;
  page.places = page.history.places(page.state.xAxis);
  page.state.frame = page.places.length - 1;
  const about = Math.max(page.state.xAxis, 0), [lengths, arms] = page.charts;
  arms.chart.title = `Moment arm about ${spoken(page.scene.coordinates[about].name)}`;
  arms.element.querySelector('h3').textContent = `${arms.chart.title} (mm)`;
  page.scene.muscles.forEach((muscle, m) => {
    Object.assign(lengths.lines[m], {x: page.places, values: page.history.lengths(m)});
    Object.assign(arms.lines[m], {x: page.places, values: page.history.arms(m, about)});
  });
  for (const chart of page.charts) chart.draw();
}

// A coordinate, or steps (-1). Until somebody chooses, plots are against the coordinate whose slider was moved last.
function plotAgainst(axis) {
  if (axis === page.state.xAxis) return;
  page.state.xAxis = axis;
  element('x-axis').value = axis;
  drawPlots();
}

// Soon, and not more often than is of use.
function plotSoon() {
  if (page.waiting) return;
  page.waiting = true;
  setTimeout(drawPlots, Math.max(0, (page.plotted || 0) + PLOT_INTERVAL - performance.now()));
}

// The least and the largest value that colors show now.
function shownRange() {
  if (page.state.colorBy === 'activation') return rangeOf(page.frame.activations);
  return rangeOf(page.frame.muscles.flatMap(({strains}) => [...strains].map(Math.log2)));
}

function drawColorBar() {
  const scale = SHAPE_COLORS[page.state.colorBy], bar = element('color-bar');
  bar.hidden = !scale || !scale.ticks;
  if (bar.hidden) return;
  bar.querySelector('b').textContent = scale.title;
  const stops = scale.colors.map(color => `rgb(${color})`);
  bar.querySelector('i').style.background = `linear-gradient(to right, ${stops})`;
  bar.querySelector('span').replaceChildren(...ticksOf(scale, shownRange()).map(tick => make('span', tick)));
}

function drawScale() {
  const pixels = 0.05 * page.stage.pixelsPerMetre();
  element('scale').style.width = `${pixels}px`;
  element('scale').querySelector('span').textContent = '50 mm';
}

function drawEverything() {
  if (!page.frame) return;
  page.stage.shapes[0].show(page.frame, page.state);
  page.stage.draw();
  drawColorBar();
  plotSoon();
}

function sayFrame(frame) {
  element('canvas').setAttribute('aria-label',
                                 `Bones and ${frame.muscles.length} muscles: ${page.textOf(frame.coordinates)}`);
  frame.coordinates.forEach((value, c) => {
    page.coordinates[c].output.textContent = page.valueText(c, value);
  });
  frame.muscles.forEach(({facts}, m) => {
    page.muscles[m].output.textContent = `${(1000 * facts[0]).toFixed(1)} mm, ${(1e6 * facts[1]).toFixed(0)} cm³`;
  });
  if (frame.milliseconds === null) return;
  page.milliseconds.push(frame.milliseconds);
  if (page.milliseconds.length > 30) page.milliseconds.shift();
  const mean = page.milliseconds.reduce((a, b) => a + b) / page.milliseconds.length;
  element('time').textContent = `${mean.toFixed(1)} ms per frame`;
}

// Before the first frame: nothing is known of fibers.
function atRest({bones, muscles, coordinates}) {
  const bodies = 1 + Math.max(...bones.map(bone => bone.body));
  const identity = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
  return {bodies: new Float32Array(Array(bodies).fill(identity).flat()), activations: muscles.map(() => 0),
          coordinates: coordinates.map(each => each.capture),
          muscles: muscles.map(({points}) => ({points, fibers: [], offsets: [0], strains: [], facts: []}))};
}

function tellMeaning(method) {
  element('meaning').textContent = page.scene.methods[method].meaning.replaceAll('`', '');
}

const heard = {
  scene(scene) {
    page.scene = scene;
    page.history = new History(scene);
    page.state.visible = new Set(scene.muscles.map(muscle => muscle.name));
    buildControls(scene);
    buildCharts(scene);
    if (ownScene) tellOwn(scene);
    page.stage = new Stage([scene.axes], element('canvas'), () => new LiveShapes(scene));
    page.stage.drawn = drawScale;
    page.pulling = new Pulling(element('view'), page.stage, page.stage.shapes[0], (bone, point, target, looking) => {
      page.pause();
      page.send('pull', {bone, point, target, looking});
    });
    page.frame = atRest(scene);
    drawEverything();
    page.stage.lookFrom(inScene(DIRECTIONS['front right']));
    if (!page.stage.renderer) page.tell('This browser draws no WebGL: numbers and plots follow the sliders, the picture does not', true);
  },
  frame(frame) {
    page.frame = frame;
    if (frame.milliseconds === null) page.history.last = null;
    page.history.add(frame);
    sayFrame(frame);
    drawEverything();
  },
  status({text}) {
    const ready = text === 'ready';
    if (ready) for (const id of ['method', 'play', 'reset']) element(id).disabled = false;
    if (ready && page.frame) tellMeaning(page.frame.method);
    if (ready && page.playing) return page.swing();
    page.tell(ready ? '' : text);
  },
  aim({coordinates}) {
    coordinates.forEach((value, c) => {
      page.setSlider(c, value);
      page.coordinates[c].say();
    });
  },
  // A final one leaves it to the user what to try next, if there is anything to choose from.
  failure({text, final}) {
    ++page.failures;
    page.pause();
    page.tell(`stopped: ${text}${!final ? '; starting again' : page.scene ? '; another method may do' : ''}`, true);
    if (!page.scene) return;
    setSliders();
    if (final) for (const id of ['method', 'reset']) element(id).disabled = false;
  },
};

// To the capture pose, relaxed.
function setSliders() {
  page.scene.coordinates.forEach(({capture}, c) => page.setSlider(c, capture));
  for (const {slider} of page.muscles) slider.value = 0;
  for (const row of [...page.coordinates, ...page.muscles]) row.say();
}

function startAgain(task, what) {
  page.pause();
  page.history.clear();
  page.milliseconds = [];
  if (task === 'reset') setSliders();
  page.send(task, what);
}

element('method').addEventListener('change', event => {
  const method = Number(event.target.value);
  tellMeaning(method);
  startAgain('choose', {method});
});
element('reset').addEventListener('click', () => startAgain('reset'));
element('play').addEventListener('click', () => page.playing ? page.pause() : page.play());
element('clear').addEventListener('click', () => { page.history.clear(); if (page.frame) page.history.add(page.frame); drawPlots(); });
element('color-by').addEventListener('change', event => { page.state.colorBy = event.target.value; drawEverything(); });
element('x-axis').addEventListener('change', event => { page.axisIsChosen = true; plotAgainst(Number(event.target.value)); });
for (const name of ['bones', 'fibers', 'wireframe'])
  element(name).addEventListener('change', event => { page.state[name] = event.target.checked; drawEverything(); });

page.worker = new Worker(URL.createObjectURL(new Blob([element('worker').textContent], {type: 'text/javascript'})));
page.worker.onmessage = ({data}) => heard[data.kind](data);
page.worker.onerror = event => page.tell(`The program does not start here: ${event.message}`, true);
page.send('begin', {bytes: bytesOf('program'), scene: ownScene, method: 0});
