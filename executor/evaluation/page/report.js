// Shows the data of the report.
(() => {
  const KINDS = ['success', 'failure', 'error', 'crashed', 'timeout'];
  const LETTERS = { failure: 'F', error: 'E', crashed: 'C', timeout: 'T', invalid: 'I', lost: 'L', cancelled: 'X' };
  const kindOf = (outcome) => (KINDS.includes(outcome) ? outcome : 'other');

  function header() {
    add(root, 'h1', {}, data.evaluation);
    add(root, 'p', { class: 'soft' }, data.project);
    const world = data.plan.universe;
    if (world) add(root, 'p', { class: 'soft' }, `${world.name}, version ${world.version}`);
    const made = card('Success');
    add(made, 'div', { class: 'big' }, data.counted ? percent(data.rate) : 'no runs');
    const kind = data.sequential ? 'confidence sequence' : 'interval';
    add(made, 'p', {}, `${data.successes} of ${data.counted} runs; 95 % ${kind} ${percent(data.low)} to ${percent(data.high)}`);
    if (data.stopped_early) add(made, 'p', {}, 'Stopped early: the interval was narrow enough.');
    if (!data.complete) add(made, 'p', { class: 'fails' }, `Incomplete: ${data.counted} of ${data.wanted} runs count.`);
    for (const note of data.notes) add(made, 'p', { class: 'soft' }, note);
    for (const gate of data.gates) add(made, 'p', { class: gate.passes ? 'passes' : 'fails' }, gate.text);
    if (data.against) for (const line of data.against.lines) add(made, 'p', {}, line);
  }

  function grid() {
    const made = card('Runs by seed');
    const columns = 40;
    const size = 22;
    const rows = Math.ceil(data.runs.length / columns);
    const wide = Math.min(columns, Math.max(data.runs.length, 1)) * size;
    const picture = draw(made, 'svg', { viewBox: `0 0 ${wide} ${rows * size}`, width: wide, role: 'img', 'aria-label': 'One square a seed, coloured by outcome' });
    data.runs.forEach((run, index) => {
      const x = (index % columns) * size;
      const y = Math.floor(index / columns) * size;
      const cell = draw(picture, 'rect', { x: x + 1, y: y + 1, width: size - 2, height: size - 2, rx: 3, class: `fill-${kindOf(run.outcome)}` });
      draw(cell, 'title', {}, `seed ${run.seed}: ${run.outcome} after ${short(run.end_s)} s: ${run.why}`);
      if (run.outcome !== 'success') draw(picture, 'text', { x: x + size / 2, y: y + size / 2 + 4, class: 'mark' }, LETTERS[run.outcome] ?? '?');
    });
    const legend = add(made, 'ul', { class: 'legend' });
    for (const [outcome, count] of Object.entries(data.counts)) {
      const item = add(legend, 'li');
      const mark = draw(item, 'svg', { width: 12, height: 12 });
      draw(mark, 'rect', { width: 12, height: 12, rx: 3, class: `fill-${kindOf(outcome)}` });
      item.append(`${count} ${outcome}`);
    }
  }

  function bounds() {
    const points = [
      ...data.plan.outlines.flat(),
      ...data.plan.areas.flatMap((area) => area.corners),
      ...data.runs.flatMap((run) => run.path),
    ];
    let [x0, y0, x1, y1] = [-1, -1, 1, 1];
    if (points.length > 0) [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
    for (const [x, y] of points) [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
    const margin = 0.05 * Math.max(x1 - x0, y1 - y0, 1);
    return { x: x0 - margin, y: y0 - margin, width: x1 - x0 + 2 * margin, height: y1 - y0 + 2 * margin };
  }

  const box = bounds();
  const flat = (points) => points.map(([x, y]) => `${x},${-y}`).join(' ');

  function map(parent, label) {
    const picture = draw(parent, 'svg', { class: 'wide', viewBox: `${box.x} ${-box.y - box.height} ${box.width} ${box.height}`, role: 'img', 'aria-label': label });
    for (const outline of data.plan.outlines) draw(picture, 'polygon', { points: flat(outline), class: 'wall' });
    for (const area of data.plan.areas) {
      const shape = draw(picture, 'polygon', { points: flat(area.corners), class: 'area' });
      draw(shape, 'title', {}, area.name);
    }
    return picture;
  }

  function places() {
    const both = add(root, 'div', { class: 'pair' });
    const ways = card('Ways', both);
    const picture = map(ways, 'Plan of the world with the way of each run');
    const ordered = [...data.runs].sort((a, b) => (b.outcome === 'success') - (a.outcome === 'success'));
    for (const run of ordered) {
      const way = draw(picture, 'polyline', { points: flat(run.path), class: `path stroke-${kindOf(run.outcome)}` });
      draw(way, 'title', {}, `seed ${run.seed}: ${run.outcome}`);
    }
    const bumps = data.runs.flatMap((run) => run.bumps);
    const heat = card('Collisions', both);
    if (bumps.length === 0) {
      add(heat, 'p', { class: 'soft' }, 'None.');
      return;
    }
    const plan = map(heat, 'Plan of the world with the places of collisions');
    const size = Math.max(box.width, box.height) / 40;
    const cells = new Map();
    for (const [x, y] of bumps) {
      const key = `${Math.floor(x / size)},${Math.floor(y / size)}`;
      cells.set(key, (cells.get(key) ?? 0) + 1);
    }
    const most = Math.max(...cells.values());
    for (const [key, count] of cells) {
      const [column, row] = key.split(',').map(Number);
      const cell = draw(plan, 'rect', { x: column * size, y: -(row + 1) * size, width: size, height: size, class: 'heat', opacity: 0.25 + (0.75 * count) / most });
      draw(cell, 'title', {}, `${count} collisions`);
    }
  }

  function histogram(parent, name, values) {
    const made = add(parent, 'div');
    add(made, 'p', {}, name);
    const numbers = values.map(([, value]) => value);
    const low = Math.min(...numbers);
    const high = Math.max(...numbers);
    const bins = low === high ? 1 : Math.min(30, Math.max(5, Math.ceil(Math.sqrt(numbers.length))));
    const counts = new Array(bins).fill(0);
    for (const value of numbers) counts[high === low ? 0 : Math.min(bins - 1, Math.floor(((value - low) / (high - low)) * bins))] += 1;
    const picture = draw(made, 'svg', { class: 'wide', viewBox: '0 0 320 120', role: 'img', 'aria-label': `Distribution of ${name}` });
    const most = Math.max(...counts);
    counts.forEach((count, index) => {
      const height = (count / most) * 92;
      const bar = draw(picture, 'rect', { x: (index * 320) / bins + 1, y: 98 - height, width: 320 / bins - 2, height, class: 'bar' });
      draw(bar, 'title', {}, `${count} runs from ${short(low + ((high - low) * index) / bins)} to ${short(low + ((high - low) * (index + 1)) / bins)}`);
    });
    draw(picture, 'line', { x1: 0, y1: 98, x2: 320, y2: 98, class: 'axis' });
    draw(picture, 'text', { x: 0, y: 114 }, short(low));
    draw(picture, 'text', { x: 320, y: 114, class: 'end' }, short(high));
    draw(picture, 'text', { x: 160, y: 114, class: 'name' }, `${numbers.length} runs`);
  }

  function measures() {
    const names = Object.keys(data.measures);
    if (names.length === 0) return;
    const both = add(card('Measures'), 'div', { class: 'pair' });
    for (const name of names) histogram(both, name, data.measures[name]);
  }

  function row(table, cells, tag = 'td') {
    const line = add(table, 'tr');
    for (const [text, kind] of cells) add(line, tag, kind ? { class: kind } : {}, text);
  }

  function worst() {
    if (data.worst.length === 0) return;
    const made = card('Worst runs');
    for (const run of data.worst) {
      const each = add(made, 'details');
      add(each, 'summary', {}, `seed ${run.seed}: ${run.outcome} after ${short(run.end_s)} s: ${run.why}`);
      for (const item of run.items) add(each, 'p', {}, `${item.item}${item.margin === null ? '' : `: ${short(item.margin)} ${item.unit}`}`);
      for (const [name, value] of Object.entries(run.drawn)) add(each, 'p', { class: 'soft' }, `${name} = ${JSON.stringify(value)}`);
      for (const fault of run.faults) add(each, 'p', { class: 'soft' }, `fault ${JSON.stringify(fault)}`);
      add(add(each, 'p'), 'code', {}, run.command);
    }
    made.querySelector('details').open = true;
  }

  function coverage() {
    if (data.coverage.length === 0) return;
    const made = card('Coverage of the tree');
    const table = add(add(made, 'div', { class: 'scroll' }), 'table');
    row(table, [['node', ''], ['runs that ticked it', 'number'], ['SUCCESS', 'number'], ['FAILURE', 'number'], ['RUNNING', 'number'], ['SKIPPED', 'number']], 'th');
    for (const node of data.coverage) {
      const cell = (count) => [count === 0 ? 'never' : String(count), count === 0 ? 'number soft' : 'number'];
      row(table, [[node.node, node.runs === 0 ? 'never' : ''], cell(node.runs), cell(node.S), cell(node.F), cell(node.R), cell(node.K)]);
    }
  }

  function platform() {
    if (data.fingerprints.length === 0) return;
    add(root, 'p', { class: 'soft' }, `Platform ${data.fingerprints.join(', ')}`);
  }

  root.replaceChildren();
  for (const part of [header, grid, places, measures, worst, coverage, platform]) part();
})();
