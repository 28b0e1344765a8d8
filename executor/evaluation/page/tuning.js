// Shows a study.
(() => {
  const WIDE = 560;
  const HIGH = 220;
  const EDGE = 44;
  const rated = (value) => (value === null ? 'undefined' : data.objective === 'success' ? percent(value) : short(value));

  const trials = data.trials.filter((trial) => trial.rating !== null);
  const better = (a, b) => (data.maximise ? a > b : a < b);

  function chart(parent, label, points, [left, right], line = []) {
    const values = points.map((point) => point.y);
    let low = Math.min(...values);
    let high = Math.max(...values);
    if (!(high > low)) [low, high] = [low - 0.5, high + 0.5];
    const span = right > left ? right - left : 1;
    const x = (value) => EDGE + ((value - left) / span) * (WIDE - 2 * EDGE);
    const y = (value) => HIGH - EDGE / 2 - ((value - low) / (high - low)) * (HIGH - EDGE);
    const picture = draw(parent, 'svg', { viewBox: `0 0 ${WIDE} ${HIGH}`, width: WIDE, role: 'img', 'aria-label': label });
    draw(picture, 'path', { class: 'axis', fill: 'none', d: `M${EDGE} 4V${HIGH - EDGE / 2}H${WIDE - 4}` });
    for (const [value, text] of [[low, rated(low)], [high, rated(high)]]) {
      draw(picture, 'text', { x: EDGE - 4, y: y(value) + 4, class: 'end' }, text);
    }
    draw(picture, 'text', { x: x(left), y: HIGH - 6 }, short(left));
    draw(picture, 'text', { x: x(right), y: HIGH - 6, class: 'end' }, short(right));
    if (line.length) draw(picture, 'path', { class: 'best', fill: 'none', d: `M${line.map((point) => `${x(point.x)} ${y(point.y)}`).join('L')}` });
    for (const point of points) {
      const dot = draw(picture, 'circle', { cx: x(point.x), cy: y(point.y), r: 4, class: 'dot' });
      draw(dot, 'title', {}, point.text);
    }
  }

  const told = (trial) =>
    `trial ${trial.number + 1}: ${rated(trial.rating)}; ${Object.entries(trial.values).map(([name, value]) => `${name} = ${short(value)}`).join(', ')}`;

  add(root, 'h1', {}, data.evaluation);
  add(root, 'p', { class: 'soft' }, data.project);
  const found = card('On fresh seeds');
  add(found, 'p', { class: data.improvement ? 'passes' : 'fails' }, data.verdict);
  const table = add(add(found, 'div', { class: 'scroll' }), 'table');
  const head = add(add(table, 'thead'), 'tr');
  for (const name of ['', data.objective, 'success, 95 % interval', 'difference, 95 % interval', ...data.ports.map((port) => port.address)]) add(head, 'th', { scope: 'col' }, name);
  const body = add(table, 'tbody');
  [['today', data.today], ...data.best.map((each, index) => [`best ${index + 1}`, each])].forEach(([title, each]) => {
    const row = add(body, 'tr');
    add(row, 'th', { scope: 'row' }, title);
    add(row, 'td', {}, rated(each.rating));
    add(row, 'td', {}, `${percent(each.rate)} (${percent(each.low)} to ${percent(each.high)}) of ${each.counted}`);
    add(row, 'td', {}, each.difference ? `${rated(each.difference[0])} (${rated(each.difference[1])} to ${rated(each.difference[2])})` : '');
    for (const port of data.ports) {
      const value = each.values[port.address];
      add(row, 'td', {}, typeof value === 'number' ? short(value) : value || 'the default');
    }
  });

  if (trials.length) {
    let best = trials[0].rating;
    const line = trials.map((trial) => {
      if (better(trial.rating, best)) best = trial.rating;
      return { x: trial.number + 1, y: best };
    });
    const points = trials.map((trial) => ({ x: trial.number + 1, y: trial.rating, text: told(trial) }));
    chart(card(`${data.objective} by trial, and the best so far`), 'One point a trial', points, [1, Math.max(data.trials.length, 2)], line);
    for (const port of data.ports) {
      const values = trials.map((trial) => ({ x: trial.values[port.address], y: trial.rating, text: told(trial) }));
      chart(card(port.address), `${data.objective} by ${port.address}`, values, [port.low, port.high]);
    }
  }
  add(root, 'p', { class: 'soft' }, `${trials.length} of ${data.trials.length} trials were rated. Trials share their seeds; the values on top ran on seeds that no trial had.`);
})();
