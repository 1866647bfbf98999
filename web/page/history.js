// What has been seen since the last reset, for the plots: lengths and moment arms of every muscle, frame by frame.
const MOST_FRAMES = 3000;
const LEAST_TURN = 0.2 * Math.PI / 180, LEAST_SHIFT = 0.0002;  // of a step that tells an arm

// What a coordinate is shown in: `factor` of it to rad or m.
const unitOf = ({translation}) => translation ? {factor: 1000, mark: ' mm', name: 'millimetres'} :
                                                {factor: 180 / Math.PI, mark: '°', name: 'degrees'};

class History {
  constructor(description) {
    this.muscles = description.muscles;
    this.coordinates = description.coordinates;
    this.clear();
  }

  clear() {
    this.frames = [];
    this.last = null;
  }

  add(frame) {
    const arms = frame.muscles.map(({facts}) => [...facts.subarray(2)].map(arm => Number.isNaN(arm) ? null : arm));
    if (this.last) this.fillExcursions(frame, arms);
    this.frames.push({coordinates: frame.coordinates, activations: frame.activations, arms,
                      lengths: frame.muscles.map(({facts}) => facts[0])});
    if (this.frames.length > MOST_FRAMES) this.frames.shift();
    this.last = frame;
  }

  // Where the method knows no arms: -dL/dq of a step in which nothing but one coordinate moved (An et al. 1984).
  fillExcursions(frame, arms) {
    const turns = frame.coordinates.map((value, c) => value - this.last.coordinates[c]);
    const moved = turns.map((turn, c) => c).filter(c => turns[c] !== 0);
    const same = frame.activations.every((value, m) => value === this.last.activations[m]);
    if (!same || moved.length !== 1) return;
    if (Math.abs(turns[moved[0]]) < (this.coordinates[moved[0]].translation ? LEAST_SHIFT : LEAST_TURN)) return;
    frame.muscles.forEach(({facts}, m) => {
      const arm = arms[m][moved[0]];
      if (arm === null) arms[m][moved[0]] = -(facts[0] - this.last.muscles[m].facts[0]) / turns[moved[0]];
    });
  }

  // mm, per frame.
  lengths(muscle) { return this.frames.map(frame => 1000 * frame.lengths[muscle]); }
  arms(muscle, coordinate) {
    return this.frames.map(frame => frame.arms[muscle][coordinate] === null ? null : 1000 * frame.arms[muscle][coordinate]);
  }
  // Degrees or millimetres, or frames where no coordinate is asked for.
  places(coordinate) {
    return this.frames.map((frame, i) => coordinate < 0 ? i : frame.coordinates[coordinate] * unitOf(this.coordinates[coordinate]).factor);
  }
}
