// What the report says in words and tables.
function make(name, text = '', attributes = {}) {
  const element = document.createElement(name);
  element.textContent = text;
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

// "gluteus_maximus_r" is what programs read.
const spoken = name => name.replaceAll('_', ' ');

function tableOf(heads, caption) {
  const table = make('table', '', {class: 'facts'});
  if (caption) table.createCaption().textContent = caption;
  const row = table.createTHead().insertRow();
  for (const head of heads) row.append(make('th', head, {scope: 'col'}));
  table.createTBody();
  return table;
}

function titleOf(runs) {
  const labels = runs.map(run => run.label).join(' · '), scene = spoken(runs[0].name);
  return runs.length > 1 && runs.every(run => run.name === runs[0].name) ? `${scene}: ${labels}` : labels;
}

function writeHead(runs) {
  const count = (number, word) => `${number} ${word}${number === 1 ? '' : 's'}`;
  document.getElementById('title').textContent = titleOf(runs);
  document.getElementById('subtitle').textContent = runs.map(run =>
    (runs.length > 1 ? `${run.label}: ` : '') + `${count(run.muscles.length, 'muscle')}, ${count(run.frame_count, 'frame')}, preset ${run.manifest.preset}, ` +
    `${run.manifest.status}, ${(run.manifest.written || '').slice(0, 10)}`).join('; ');
  const verdict = document.getElementById('verdict');
  for (const run of runs) {
    const measured = run.gates.filter(gate => gate.measured);
    const missed = measured.filter(gate => !gate.met).length;
    const unmeasured = measured.length < run.gates.length ? ', others not measured' : '';
    const text = !measured.length ? 'quality gates not measured' :
                 (missed ? `${missed} of ${measured.length} quality gates missed` : 'all quality gates met') + unmeasured;
    verdict.append(make('a', (runs.length > 1 ? run.label + ': ' : '') + text,
                        {class: 'badge ' + (missed ? 'bad' : 'good'), href: '#gates-title', style: 'text-decoration: none'}),
                   ' ');
  }
}

// A row per muscle, a column per gate.
function writeGates(runs, goTo) {
  runs.forEach((run, index) => {
    if (runs.length > 1) document.getElementById('gates').append(make('h3', run.label));
    const measures = run.gates.filter(gate => gate.muscle === run.gates[0].muscle);
    const table = tableOf(['Muscle']);
    table.classList.add('gates');
    for (const gate of measures) {
      const head = make('th', gate.title, {scope: 'col'});
      head.append(make('small', ` ${limitText(gate)}`));
      table.tHead.rows[0].append(head);
    }
    for (const muscle of run.muscles) {
      const row = table.tBodies[0].insertRow();
      row.append(make('th', spoken(muscle.name), {scope: 'row'}));
      for (const each of measures) {
        row.append(gateCell(run.gates.find(gate => gate.muscle === muscle.name && gate.measure === each.measure), index, goTo));
        row.lastChild.setAttribute('data-gate', `${each.title}, ${limitText(each)}`); // what a narrow page has instead of columns' heads
      }
    }
    document.getElementById('gates').append(table);
  });
}

function limitText(gate) { return `limit ${gate.both_ways ? '±' : ''}${gate.limit} ${gate.unit}`; }

// Whether a gate is met, its worst value, and a way to the frame of it.
function gateCell(gate, index, goTo) {
  if (!gate.measured) return make('td', 'not measured');
  const cell = make('td', gate.met ? '✓ ' : '✗ ', {class: gate.met ? 'met' : 'missed'});
  const value = gate.worst === null ? 'not finite' : `${shownNumber(gate.worst)} ${gate.unit}`;
  const link = make('button', `frame ${gate.frame}`, {type: 'button', class: 'link',
                    'aria-label': `Show frame ${gate.frame}, the worst of ${spoken(gate.muscle)}: ${gate.title} ${value}, ` +
                                  (gate.met ? 'met' : 'missed')});
  link.addEventListener('click', () => goTo(gate.frame, index, gate.measure));
  cell.append(value, make('br'), link, gate.met ? '' : ` and ${gate.missed - 1} more`);
  return cell;
}

function writeWarnings(runs) {
  const place = document.getElementById('warnings');
  for (const run of runs) {
    if (runs.length > 1) place.append(make('h3', run.label));
    const {warnings = [], guessed = [], status} = run.manifest;
    const said = [...warnings];
    if (status !== 'complete') said.push(`This run is not complete: ${status}. Frames after ${run.frame_count - 1} are missing.`);
    if (guessed.length) said.push(`Guessed, not measured: ${guessed.map(spoken).join(', ')}.`);
    for (const text of said) place.append(make('p', text, {class: 'warning'}));
    if (said.length === 0) place.append(make('p', 'None: the run had nothing to complain about.'));
  }
}

function writeProvenance(runs) {
  const facts = {
    'Scene': run => run.manifest.scene, 'Preset': run => run.manifest.preset, 'Status': run => run.manifest.status,
    'Frames': run => run.frame_count, 'Written': run => run.manifest.written, 'Run folder': run => run.folder,
    'Command': run => (run.manifest.command || []).join(' '),
    'Gracilis': run => run.manifest.gracilis,
    'Libraries': run => Object.entries(run.manifest.libraries || {}).map(pair => pair.join(' ')).join(', '),
    'Machine': run => `${run.manifest.processors} processors, ${run.manifest.threads} threads used, ` +
                      `instruction set ${run.manifest.instruction_set}`,
    'Time': run => `${shownNumber(run.manifest.seconds)} s`,
  };
  const table = tableOf(runs.length > 1 ? ['', ...runs.map(run => run.label)] : ['', '']);
  if (runs.length === 1) table.deleteTHead();
  for (const [name, value] of Object.entries(facts)) {
    const row = table.tBodies[0].insertRow();
    row.append(make('th', name, {scope: 'row'}), ...runs.map(run => make('td', String(value(run) ?? ''))));
  }
  const place = document.getElementById('provenance');
  place.append(table);
  for (const run of runs) {
    const inputs = run.manifest.inputs || [];
    place.append(make('h3', 'Input files' + (runs.length > 1 ? ', ' + run.label : '')));
    if (inputs.length === 0) place.append(make('p', 'None: the scene is built in.'));
    else {
      const files = tableOf(['File', 'SHA-256']);
      for (const input of inputs) {
        const row = files.tBodies[0].insertRow();
        row.insertCell().textContent = input.file;
        row.insertCell().append(make('code', input.sha256));
      }
      place.append(files);
    }
  }
}

function writeSettings(runs) {
  const place = document.getElementById('settings');
  for (const run of runs) {
    const details = make('details');
    details.append(make('summary', 'All settings, as resolved' + (runs.length > 1 ? ': ' + run.label : '')),
                   make('pre', run.manifest.settings || ''));
    place.append(details);
  }
}
