import { describe, expect, it } from 'vitest';
import { translates } from '@/i18n';
import { examplesOf, isExample, pictureOf, SHELF } from './shelf';

const template = (id: string, universe = 'here') => ({ id, name: id, description: '', universe });

describe('examplesOf', () => {
  it('has the examples of the server, from the easiest to the hardest', () => {
    const found = examplesOf(['explore_maze', 'mine', 'laser_bump_and_go'].map((id) => template(id)));
    expect(found.map(({ id, level, number }) => [id, level, number])).toEqual([
      ['laser_bump_and_go', 1, 1],
      ['explore_maze', 3, 10],
    ]);
  });

  it('has ten examples, sorted by level', () => {
    const levels = SHELF.map(([, level]) => level);
    expect(levels).toHaveLength(10);
    expect([...levels].sort()).toEqual(levels);
  });

  it('has texts for each', () => {
    for (const [id] of SHELF) {
      expect(translates(`projects:example.${id}`), id).toBe(true);
      expect(translates(`projects:template.${id}.name`), id).toBe(true);
    }
  });
});

it('separates examples from templates', () => {
  expect([isExample('push_box'), isExample('empty')]).toEqual([true, false]);
});

it("shows the picture of an example's own world, otherwise that of the built-in universe", () => {
  const shelf = examplesOf([
    template('laser_bump_and_go', 'walled_room'),
    template('follow_line', ''),
    template('push_box'),
  ]);
  const [bump, line, box] = shelf.map(pictureOf);
  expect(bump).toBe('/api/v1/catalog/universes/walled_room/preview');
  expect(line).toBeNull();
  expect(box).toMatch(/push_box.*\.webp/);
});
