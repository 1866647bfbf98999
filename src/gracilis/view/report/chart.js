// Lines against frames or a coordinate, with what a limit is, where the slider stands, and what the pointer is at.
// As wide as there is room, so that a pixel is a pixel and text can be read on a phone, too.
const CHART = {height: 210, left: 52, right: 12, top: 10, bottom: 34};
const DASHES = ['', '7 4', '2 3', '9 3 2 3'];

function svg(name, attributes, parent) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.appendChild(element);
  return element;
}

// Round numbers from within [low, high].
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 2.5, 5, 10].find(each => each * power >= rough * 0.999);
  const list = [];
  const first = Math.ceil(low / step - 1e-9);
  for (let k = 0; k <= 2 * count + 2 && (first + k) * step <= high + 1e-9 * step; ++k) list.push((first + k) * step);
  return list;
}

function shownNumber(value) {
  if (value === null || value === undefined) return '–';
  const digits = Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : Math.abs(value) >= 1 ? 2 : 3;
  return Number(value.toFixed(digits)).toString().replace('-', '−');
}

class Chart {
  // `lines`: {name, color, dash, values, low, high, x, run, muscle}; x and values per frame of their run.
  constructor(chart, lines, page) {
    Object.assign(this, {chart, lines, page});
    this.element = document.createElement('figure');
    this.element.className = 'plot';
    const title = document.createElement('h3');
    title.textContent = chart.title + (chart.unit ? ` (${chart.unit})` : '');
    this.svg = svg('svg', {height: CHART.height, role: 'img'});
    this.width = 620;
    this.tooltip = document.createElement('div');
    this.tooltip.className = 'tooltip';
    this.tooltip.hidden = true;
    this.element.append(title, this.svg, this.tooltip);
    this.svg.addEventListener('pointermove', event => this.point(event));
    this.svg.addEventListener('pointerleave', () => { this.tooltip.hidden = true; this.moveCursor(); });
    this.svg.addEventListener('click', event => page.goTo(this.frameAt(event)));
    new ResizeObserver(() => { if (this.cursor && this.room() !== this.width) this.draw(); }).observe(this.svg);
  }

  // Pixels; as before where nothing is laid out.
  room() { return Math.round(this.svg.getBoundingClientRect().width) || this.width; }

  shownLines() { return this.lines.filter(line => this.page.state.visible.has(line.muscle)); }

  draw(width = this.room()) {
    this.width = width;
    this.svg.setAttribute('viewBox', `0 0 ${width} ${CHART.height}`);
    this.svg.replaceChildren();
    const lines = this.shownLines();
    const numbers = key => lines.flatMap(line => line[key] || []).filter(value => value !== null);
    const x = numbers('x'), y = this.page.runCount > 1 ? numbers('values') : [...numbers('values'), ...numbers('low'), ...numbers('high')];
    if (y.length === 0) y.push(0, 1);
    if (x.length === 0) x.push(0, 1);
    // (Math.min(...x) would overflow the stack on long runs.)
    const least = list => list.reduce((a, b) => Math.min(a, b)), most = list => list.reduce((a, b) => Math.max(a, b));
    let low = least(y), high = most(y);
    // A limit is drawn where it is near, so that it does not squeeze the lines.
    this.limits = this.chart.limits.filter(limit => limit >= low - 2 * Math.max(high - low, Math.abs(limit) / 2) &&
                                                    limit <= high + 2 * Math.max(high - low, Math.abs(limit) / 2));
    low = Math.min(low, ...this.limits);
    high = Math.max(high, ...this.limits);
    if (high - low < 1e-6) [low, high] = [low - 0.5, high + 0.5];
    const margin = 0.06 * (high - low);
    this.range = {x: [least(x), Math.max(most(x), least(x) + 1e-9)], y: [low - margin, high + margin]};
    this.drawAxes();
    for (const limit of this.limits) this.drawLimit(limit);
    for (const line of lines) this.drawLine(line);
    this.cursor = svg('g', {}, this.svg);
    this.moveCursor();
    this.describe(lines);
  }

  px(x) {
    const [low, high] = this.range.x;
    return CHART.left + (x - low) / (high - low) * (this.width - CHART.left - CHART.right);
  }

  py(y) {
    const [low, high] = this.range.y;
    return CHART.height - CHART.bottom - (y - low) / (high - low) * (CHART.height - CHART.top - CHART.bottom);
  }

  drawAxes() {
    const bottom = CHART.height - CHART.bottom, right = this.width - CHART.right;
    for (const y of ticks(...this.range.y, 5)) {
      svg('line', {x1: CHART.left, x2: right, y1: this.py(y), y2: this.py(y), stroke: '#e3e7ea'}, this.svg);
      svg('text', {x: CHART.left - 6, y: this.py(y) + 4, 'text-anchor': 'end'}, this.svg).textContent = shownNumber(y);
    }
    for (const x of ticks(...this.range.x, Math.max(2, Math.round((right - CHART.left) / 70)))) {
      svg('line', {x1: this.px(x), x2: this.px(x), y1: bottom, y2: bottom + 4, stroke: '#56606a'}, this.svg);
      svg('text', {x: this.px(x), y: bottom + 16, 'text-anchor': 'middle'}, this.svg).textContent = shownNumber(x);
    }
    svg('line', {x1: CHART.left, x2: right, y1: bottom, y2: bottom, stroke: '#56606a'}, this.svg);
    svg('text', {x: right, y: CHART.height - 3, 'text-anchor': 'end'}, this.svg).textContent = this.page.xLabel();
  }

  drawLimit(limit) {
    const y = this.py(limit), right = this.width - CHART.right;
    svg('line', {x1: CHART.left, x2: right, y1: y, y2: y, stroke: '#a8200d', 'stroke-dasharray': '5 4'}, this.svg);
    svg('text', {x: right, y: y - 4, 'text-anchor': 'end', style: 'fill: #a8200d'}, this.svg).textContent = 'limit';
  }

  // Empty values interrupt a line.
  path(xs, ys) {
    let text = '', pen = 'M';
    ys.forEach((y, i) => {
      if (y === null || xs[i] === null) { pen = 'M'; return; }
      text += `${pen}${this.px(xs[i]).toFixed(1)} ${this.py(y).toFixed(1)}`;
      pen = 'L';
    });
    return text;
  }

  drawLine(line) {
    if (line.low && this.page.runCount === 1) {
      const there = line.values.map((value, i) => i).filter(i => line.values[i] !== null);
      const outline = this.path(there.map(i => line.x[i]), there.map(i => line.high[i])) +
        this.path(there.map(i => line.x[i]).reverse(), there.map(i => line.low[i]).reverse()).replace('M', 'L');
      svg('path', {d: outline + 'Z', fill: line.color, 'fill-opacity': 0.12}, this.svg);
    }
    svg('path', {d: this.path(line.x, line.values), fill: 'none', stroke: line.color, 'stroke-width': 1.8,
                 'stroke-dasharray': line.dash, 'stroke-linejoin': 'round'}, this.svg);
  }

  // Where all runs stand, or `frame` of the first under the pointer.
  moveCursor(frame = this.page.state.frame) {
    if (!this.cursor) return;
    this.cursor.replaceChildren();
    const x = this.px(this.page.xOf(0)[this.page.frameOf(0, frame)]);
    svg('line', {x1: x, x2: x, y1: CHART.top, y2: CHART.height - CHART.bottom, stroke: '#1d2327'}, this.cursor);
    for (const line of this.shownLines()) {
      const at = this.page.frameOf(line.run, frame);
      if (line.values[at] === null || line.values[at] === undefined) continue;
      svg('circle', {cx: this.px(line.x[at]), cy: this.py(line.values[at]), r: 3.2, fill: line.color, stroke: '#fff'},
          this.cursor);
    }
  }

  // The frame of the first run whose place is nearest to the pointer; of several, the one nearest to the slider.
  frameAt(event) {
    const box = this.svg.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * this.width;
    let best = 0, distance = Infinity;
    this.page.xOf(0).forEach((value, frame) => {
      const away = Math.abs(this.px(value) - x) + 1e-3 * Math.abs(frame - this.page.state.frame);
      if (away < distance) [best, distance] = [frame, away];
    });
    return best;
  }

  point(event) {
    const frame = this.frameAt(event);
    this.moveCursor(frame);
    const rows = this.shownLines().map(line => {
      const value = line.values[this.page.frameOf(line.run, frame)];
      const row = document.createElement('tr'), name = row.insertCell(), number = row.insertCell();
      const swatch = document.createElement('span');
      swatch.className = 'swatch';
      swatch.style.background = line.color;
      name.append(swatch, line.name);
      number.textContent = shownNumber(value);
      return row;
    });
    const table = document.createElement('table'), head = document.createElement('b');
    table.append(...rows);
    head.textContent = this.page.poseText(frame);
    this.tooltip.replaceChildren(head, table);
    this.tooltip.hidden = false;
    const box = this.element.getBoundingClientRect(), x = event.clientX - box.left;
    this.tooltip.style.left = x < box.width / 2 ? `${x + 14}px` : `${x - this.tooltip.offsetWidth - 14}px`;
    this.tooltip.style.top = '1.6rem';
  }

  describe(lines) {
    const spans = lines.map(line => {
      const there = line.values.filter(value => value !== null);
      if (there.length === 0) return `${line.name}: no values`;
      const least = there.reduce((a, b) => Math.min(a, b)), most = there.reduce((a, b) => Math.max(a, b));
      return `${line.name}: ${shownNumber(least)} to ${shownNumber(most)}`;
    });
    this.svg.setAttribute('aria-label', `${this.chart.title}, ${this.chart.unit}. ${spans.join('; ')}`);
  }
}
