// An adapter for the library gcode-toolpath of CNCjs, which makes lines and arcs of G-code.
//
// npm install gcode-toolpath@3.0.0
// gaugeblock certify --controller "exec:node examples/libraries/gcode_toolpath_adapter.js"
//
// The library reads each line; the adapter reports lines, arcs, modes and position. The library's lengths are
// millimetres; the protocol's are in the unit of the program. Codes that it keeps as a name alone (probing, G43.1, G54,
// M6) and codes that it ignores are not in the declared language. It knows no end of a program: M2 changes no mode, so
// that the motion mode, which each M2 sets, is not reported.
'use strict';
const readline = require('readline');
const Toolpath = require('gcode-toolpath');

const DECLARATION = {
  protocol: 1, name: 'gcode-toolpath', version: '3.0.0', languages: ['rs274'], units: ['mm'], features: [],
  observables: {
    fields: ['units', 'plane', 'distance', 'feed_mode', 'spindle', 'mist', 'flood', 'position'],
    fields_at_effects: ['units', 'plane', 'distance'], effects: ['straight_traverse', 'straight_feed', 'arc_feed'],
    moves_in_place: false, fault_kinds: false, final_parameters: false, refusals: false, pins: [],
  },
  language: {
    g: ['0', '1', '2', '3', '17', '18', '19', '20', '21', '80', '90', '91', '92', '92.1', '93', '94', '95'],
    m: ['2', '3', '4', '5', '7', '8', '9', '30'],
    words: { G2: 'XYZIJKR', G3: 'XYZIJKR', G92: 'XYZ' },
    axes: 'XYZ', letters: 'FSN', parameters: [], expressions: false, o_words: false,
    comments: ['parentheses', 'semicolon'],
  },
  resolution: 0, clock: 'virtual', edition: 'linuxcnc-2.9',
  options: {
    'modal-groups.initial-motion': 'traverse', 'motion.without-axis-words': 'move-in-place',
    'coolant.both-in-one-block': 'accepted', 'arcs.zero-radius': 'accepted', 'arcs.offsets-alone': 'arc',
    'text.comment-nested': 'plain', 'text.percent-alone': 'ignored', 'text.line-end-counted': 'not-counted',
  },
};
const MODES = {
  G20: 'inch', G21: 'mm', G17: 'xy', G18: 'zx', G19: 'yz', G90: 'absolute', G91: 'incremental',
  G93: 'inverse_time', G94: 'per_minute', G95: 'per_revolution', M3: 'clockwise', M4: 'counterclockwise', M5: 'stopped',
};
const EFFECTS = { G0: 'straight_traverse', G1: 'straight_feed' };
// What the protocol calls the library's modes.
function settings(modal) {
  const coolant = modal.coolant.split(',');
  return {
    units: MODES[modal.units], plane: MODES[modal.plane], distance: MODES[modal.distance],
    feed_mode: MODES[modal.feedrate], spindle: { 0: MODES[modal.spindle] },
    mist: coolant.includes('M7') ? 'on' : 'off', flood: coolant.includes('M8') ? 'on' : 'off',
  };
}

function run(program) {
  let events = [];
  const steps = [];
  // Lines and arcs have the G92 offset added; without it they are in program coordinates.
  const offset = { x: 0, y: 0, z: 0 };
  const unit = () => (toolpath.getModal().units === 'G20' ? 25.4 : 1);
  const point = ({ x, y, z }) => ({ x: x / unit(), y: y / unit(), z: z / unit() });
  const without = ({ x, y, z }) => point({ x: x - offset.x, y: y - offset.y, z: z - offset.z });
  let known = {};
  const noteSettings = (modal) => {
    const [before, changed] = [known, {}];
    known = settings(modal);
    const differs = (field) => JSON.stringify(known[field]) !== JSON.stringify(before[field]);
    Object.keys(known).filter(differs).forEach((field) => { changed[field] = known[field]; });
    if (Object.keys(changed).length > 0) {
      events.push({ set: changed });
    }
  };
  const toolpath = new Toolpath({
    addLine: (modal, start, end) => {
      noteSettings(modal);
      events.push({ do: { effect: EFFECTS[modal.motion], end: without(end) } });
    },
    addArcCurve: (modal, start, end, centre) => {
      // Of an arc the library names the axes in the order of the plane: the first is x, the normal is z.
      const axes = { G17: ['x', 'y', 'z'], G18: ['z', 'x', 'y'], G19: ['y', 'z', 'x'] }[modal.plane];
      const named = ({ x, y, z }) => ({ [axes[0]]: x, [axes[1]]: y, [axes[2]]: z });
      const [to, middle] = [without(named(end)), without(named(centre))];
      const [first, second] = axes.map((axis) => middle[axis]);
      const arc = { first_centre: first, second_centre: second, turns: modal.motion === 'G2' ? -1 : 1 };
      noteSettings(modal);
      events.push({ do: { effect: 'arc_feed', end: to, ...arc } });
    },
  });
  const start = settings(toolpath.getModal());
  known = start;
  const lines = program.split('\n');
  for (let number = 1; number <= lines.length; number += 1) {
    events = [];
    const before = toolpath.getPosition();
    const [line] = toolpath.loadFromStringSync(lines[number - 1]);
    if (!line || (line.words.length === 0 && line.ln === undefined)) {
      continue;
    }
    const state = { language: 'rs274', position: point(toolpath.getPosition()) };
    noteSettings(toolpath.getModal());
    steps.push({ block: { file: 'main.ngc', line: number }, events, state });
    const has = (letter, value) => line.words.some((word) => word[0] === letter && word[1] === value);
    const after = toolpath.getPosition();
    if (has('G', 92) || has('G', 92.1)) {
      if (events.some((event) => event.do)) return { unsupported: 'the offset of a move in a block of G92 or G92.1' };
      // The library does not say its offset: it is what the position has changed by.
      ['x', 'y', 'z'].forEach((axis) => { offset[axis] += before[axis] - after[axis]; });
    }
    if (has('M', 2) || has('M', 30)) {
      return { outcome: { language: 'rs274', start, steps, end: { end: 'program_end' } } };
    }
  }
  return { unsupported: 'the library reads lines; it does not know that a program has an end' };
}

readline.createInterface({ input: process.stdin }).on('line', (text) => {
  const request = JSON.parse(text);
  const answers = { hello: () => ({ hello: DECLARATION }), reset: () => ({ done: {} }), bye: () => ({ done: {} }) };
  answers.run = () => run(request.scenario.program.main);
  const answer = (answers[request.op] || (() => ({ refused: 'unknown operation' })))();
  process.stdout.write(`${JSON.stringify({ id: request.id, ...answer })}\n`);
  if (request.op === 'bye') {
    process.exit(0);
  }
});
