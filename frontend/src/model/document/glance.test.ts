import { describe, expect, it } from 'vitest';
import { nameIn, robotIn, titleOf } from './glance';

it.each([
  ['walled_room', 'Walled room'],
  ['x', 'X'],
  ['', ''],
])('%s is called %s', (id, title) => {
  expect(titleOf(id)).toBe(title);
});

describe('the name of a document', () => {
  it.each([
    ['format: x\nname: Walled room\n', 'Walled room'],
    ['name: Hall # the large one', 'Hall'],
    ['name: "The \\"old\\" # hall"', 'The "old" # hall'],
    ["name: 'Ann''s yard'", "Ann's yard"],
    ['name: C#', 'C#'],
    ['models:\n  - {name: crate}', null],
    ['name:\n', null],
    ['name: |\n  Hall', null],
    ['name: ""', null],
  ])('of %j is %j', (text, name) => {
    expect(nameIn(text)).toBe(name);
  });
});

describe('the robot of a universe', () => {
  it.each([
    ['robots:\n  - {id: robot, model: turtle2, pose: [0, 0]}\nlights: []', 'turtle2'],
    ['robots:\n\n# the first\n- id: a\n  model: "rover"\n- {model: burger}\n', 'rover'],
    ['robots: [{id: a, model: waffle}]', 'waffle'],
    ['robots: []\nactors:\n  - {id: a, model: person}', null],
    ['actors:\n  - {id: a, model: person}', null],
  ])('of %j is %j', (text, robot) => {
    expect(robotIn(text)).toBe(robot);
  });
});
