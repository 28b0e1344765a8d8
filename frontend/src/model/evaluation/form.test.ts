import { describe, expect, it } from 'vitest';
import { readForm, withItem, withMeasures, withNumber, withVariation } from './form';

const TEXT = `format: bt-studio/evaluation
version: 1
duration_s: 60 # a minute
runs: 200
vary:
  robot.pose: {area: middle, yaw: [0, 6.283]} # anywhere
  ground.friction: [0.6, 1.0]
judge:
  success:
    - never: collision # the wall too
    - reach: {area: door, within_s: 60}
  measure: [path_length_m]
`;
const linesOf = (text: string) => text.split('\n');
/** Returns the lines that only one of two texts has. */
const changed = (after: string) => [
  ...linesOf(TEXT).filter((line) => !linesOf(after).includes(line)),
  ...linesOf(after).filter((line) => !linesOf(TEXT).includes(line)),
];

describe('the form of an evaluation', () => {
  it('shows what it knows, and counts the rest', () => {
    expect(readForm(TEXT)).toEqual({
      duration_s: 60,
      runs: 200,
      seed: 0,
      neverCollision: true,
      closer_than_m: null,
      closerTo: 'anything',
      treeSucceeds: false,
      measures: ['path_length_m'],
      vary: [
        { address: 'robot.pose', from: null, to: null },
        { address: 'ground.friction', from: 0.6, to: 1 },
      ],
      otherItems: 1,
      faults: 0,
    });
  });

  it.each(['- a', 'a: [', '', '3'])('cannot show %j', (text) => {
    expect(readForm(text)).toBeNull();
  });

  it('changes a number, and keeps the comment', () => {
    expect(changed(withNumber(TEXT, 'duration_s', 30))).toEqual([
      'duration_s: 60 # a minute',
      'duration_s: 30 # a minute',
    ]);
    expect(readForm(withNumber(TEXT, 'seed', 7))?.seed).toBe(7);
    expect(readForm(withNumber(TEXT, 'runs', null))?.runs).toBeNull();
  });

  it('adds, changes and removes items of the judge beside those that it does not know', () => {
    const closer = withItem(TEXT, 'closer', { never: { closer_than_m: 0.1, to: 'actors' } });
    expect(readForm(closer)).toMatchObject({ closer_than_m: 0.1, closerTo: 'actors', otherItems: 1 });
    expect(closer).toContain('- never: collision # the wall too');
    const nearer = withItem(closer, 'closer', { never: { closer_than_m: 0.2, to: 'actors' } });
    expect(readForm(nearer)).toMatchObject({ closer_than_m: 0.2, otherItems: 1 });
    const without = withItem(nearer, 'collision', null);
    expect(readForm(without)).toMatchObject({ neverCollision: false, closer_than_m: 0.2, otherItems: 1 });
    expect(withItem(without, 'collision', null)).toBe(without);
    expect(readForm(withItem('version: 1\n', 'tree', { tree: 'SUCCESS' }))?.treeSucceeds).toBe(true);
  });

  it('chooses measures', () => {
    const text = withMeasures(TEXT, ['path_length_m', 'energy_j']);
    expect(readForm(text)?.measures).toEqual(['path_length_m', 'energy_j']);
  });

  it('adds, renames, changes and removes what varies', () => {
    const added = withVariation(TEXT, null, { address: 'sensors.scan.noise_m', from: 0, to: 0.03 });
    expect(readForm(added)?.vary.at(-1)).toEqual({ address: 'sensors.scan.noise_m', from: 0, to: 0.03 });
    const renamed = withVariation(TEXT, 'ground.friction', { address: 'robot.pose.x', from: 0.6, to: 2 });
    expect(readForm(renamed)?.vary.at(-1)).toEqual({ address: 'robot.pose.x', from: 0.6, to: 2 });
    expect(renamed).toContain('# anywhere');
    expect(readForm(withVariation(TEXT, 'robot.pose', null))?.vary).toHaveLength(1);
    expect(withVariation(TEXT, null, null)).toBe(TEXT);
  });
});
