// What colors of the view mean, and how values become colors.
const DIVERGING = [[33, 102, 172], [146, 197, 222], [247, 244, 238], [244, 165, 130], [178, 24, 43]];
const DIVERGING_LINES = [[20, 70, 150], [75, 125, 175], [150, 150, 150], [195, 98, 72], [165, 20, 40]];
const RISING = [[250, 240, 225], [240, 170, 120], [205, 70, 60], [110, 10, 60]];
const SHAPE_COLORS = {
  natural: {label: 'natural'},
  muscle: {label: 'by muscle'},
  stretch: {label: 'by edge stretch', title: 'edge length, × rest', colors: DIVERGING, low: -1, high: 1,
            ticks: ['0.5', '1', '2']},
  shape: {label: 'by gates of shape', title: 'spikes, thickness, edges: share of their bars', colors: RISING, low: 0, high: 1,
          ticks: ['0', '0.5', '1']},
  volume: {label: 'by volume', title: 'change of volume, %', colors: DIVERGING, low: -1, high: 1,
           ticks: ['−1', '0', '+1'], chart: 'volume_ratio'},
  activation: {label: 'by activation', title: 'activation', colors: RISING, low: 0, high: 1, ticks: ['0', '0.5', '1'],
               chart: 'activation'},
  strain: {label: 'by fiber length', title: 'fiber length, × rest', colors: DIVERGING_LINES, low: -0.585,
           high: 0.585, ticks: ['0.67', '1', '1.5'], fibers: true},
};

// Of muscles whose fibers carry the colors, as flesh_color() of palette.hpp: neither bone nor a color of a scale.
const FLESH = [0.88, 0.76, 0.72];

// A color of a list that is spread over [low, high]; components 0 ... 1.
function colorAt(scale, value) {
  const colors = scale.colors;
  const at = Math.min(Math.max((value - scale.low) / (scale.high - scale.low), 0), 1) * (colors.length - 1);
  const i = Math.min(Math.floor(at), colors.length - 2);
  return [0, 1, 2].map(k => (colors[i][k] + (at - i) * (colors[i + 1][k] - colors[i][k])) / 255);
}

// What stands below a scale's bar where values from `least` to `most` are shown: an end that they go beyond says so.
function ticksOf(scale, [least, most]) {
  const ticks = [...scale.ticks], last = ticks.length - 1, rounding = 1e-6;
  if (least < scale.low - rounding) ticks[0] = `≤ ${ticks[0]}`;
  if (most > scale.high + rounding) ticks[last] = `≥ ${ticks[last]}`;
  return ticks;
}

function rangeOf(values) {
  let least = Infinity, most = -Infinity;
  for (const value of values) {
    if (value === null) continue;
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return [least, most];
}

// Of values that are stored as whole numbers: no farther out than they are for certain.
function rangeOfBytes(arrays, valueOf) {
  const [least, most] = rangeOf(arrays.flatMap(rangeOf));
  return [valueOf(least + 0.5), valueOf(most - 0.5)];
}

const logRatioOf = byte => (byte - 128) / 126;
const shareOf = byte => byte / 200;

// Stripes along the fibers: a row of gray pixels that repeats.
function stripeTexture(brightness) {
  const texture = new THREE.DataTexture(brightness, brightness.length, 1, THREE.LuminanceFormat);
  Object.assign(texture, {wrapS: THREE.RepeatWrapping, magFilter: THREE.LinearFilter, generateMipmaps: true,
                          minFilter: THREE.LinearMipmapLinearFilter, needsUpdate: true});
  return texture;
}

// Colors per vertex of what is belly and what is tendon: bytes, 255 where all is tendon.
function tissueColors(belly, tendon, bytes) {
  const colors = new Float32Array(3 * bytes.length);
  bytes.forEach((byte, v) => {
    for (let k = 0; k < 3; ++k) colors[3 * v + k] = belly[k] + byte / 255 * (tendon[k] - belly[k]);
  });
  return colors;
}
