'use strict';
// What the pages of an evaluation and of a study share. All foreign text goes through textContent; nothing is
// parsed as HTML.
const data = JSON.parse(document.getElementById('data').textContent);
const root = document.getElementById('report');
const SVG = 'http://www.w3.org/2000/svg';
const percent = (value) => `${(value * 100).toFixed(1)} %`;
const short = (value) => (Math.abs(value) >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(4))));

function add(parent, name, attributes = {}, text = undefined) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

function draw(parent, name, attributes = {}, text = undefined) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  parent.append(made);
  return made;
}

function card(title, parent = root) {
  const made = add(parent, 'section', { class: 'card' });
  add(made, 'h2', {}, title);
  return made;
}
