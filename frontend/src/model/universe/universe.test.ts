import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  add,
  addWaypoint,
  duplicate,
  move,
  remove,
  removeWaypoint,
  rename,
  setField,
  setWaypoint,
  setWorld,
  turn,
  type Edit,
} from './edits';
import { stretched, wallBetween } from './geometry';
import { record, redo, seal, startUndo, undo, type TextUndo } from '../document/undo';
import { applyOps, sameValue } from '../document/ops';
import { readUniverse } from './read';
import { rewrite, UnwritableError } from '../document/rewrite';
import { difference, inverse, spliced } from '../document/splice';
import type { Universe } from './types';

const builtins = Object.entries(
  import.meta.glob<string>('../../../../executor/universes/*.yaml', {
    eager: true,
    query: '?raw',
    import: 'default',
  }),
);

const ROOM = `# My room
format: bt-studio/universe
version: 1
name:   Room   # two spaces stay
ground: {color: "#d8d4cc", friction: 0.9}
models:
  # Walls
  - {id: north, shape: box, size: [10, 0.2, 1.0], pose: [0, 5, 0.50, 0, 0, 0], color: "#8899aa"}   # cold

  - id: crate      # in block style
    shape: mesh
    file: assets/crate.obj
    pose: [2, 1, 0.3, 0, 0, 0]
    mass: 2.0
  - {id: ball, shape: sphere, size: [0.1], pose: [1, 1, 0.1, 0, 0, 0]}
actors:
  - {id: walker, path: [[1, 0], [3, 2], [0, 3]], speed: 0.5}
random: {crate.pose.x: [1, 3], ball.mass: [0, 1]}
`;

const universeOf = (text: string): Universe => {
  const { universe } = readUniverse(text);
  if (!universe) throw new Error('no universe');
  return universe;
};
const edited = (text: string, edit: (universe: Universe) => Edit): string =>
  rewrite(text, edit(universeOf(text)).ops);
const problemsOf = (text: string) => readUniverse(text).problems.map(({ kind, line }) => [kind, line]);

describe('reading', () => {
  it.each(builtins)('finds no problem in %s', (_, text) => {
    const { universe, problems } = readUniverse(text);
    expect(problems).toEqual([]);
    expect(universe?.things.length).toBeGreaterThan(0);
  });

  it('reports problems with their lines', () => {
    expect(problemsOf('a: [1')).toEqual([['syntax', 1]]);
    expect(problemsOf('- 1')).toEqual([['object', 1]]);
    const bad = ROOM.replace('shape: sphere', 'shape: blob')
      .replace('id: walker', 'id: north')
      .replace('mass: 2.0', 'masss: 2.0')
      .replace('ball.mass', 'ghost.mass')
      .replace('[10, 0.2, 1.0]', '[10, 0.2]')
      .replace('#8899aa', '#8899a');
    expect(problemsOf(bad)).toEqual([
      ['size', 8],
      ['color', 8],
      ['unknownNear', 14],
      ['choice', 15],
      ['sameId', 17],
      ['randomName', 18],
    ]);
    expect(readUniverse(bad).universe?.things.map(({ key }) => key)).toEqual([
      'north',
      'crate',
      'north#2',
      'robot',
    ]);
  });

  it.each([
    ['{id: a, shape: box, size: [1, 1, 0]}', 'above'],
    ['{id: a, shape: mesh}', 'needsFile'],
    ['{id: a, shape: urdf, file: assets/a.obj}', 'wrongFile'],
    ['{id: a, shape: box, size: [1, 1, 1], file: a.obj}', 'noFile'],
    ['{id: a, shape: plane, size: [1, 1], mass: 1}', 'planeMass'],
    ['{id: a, shape: sphere, size: [1], mass: 1, solid: false}', 'ghostMass'],
    ['{id: a, shape: sphere, size: [1], to_ceiling: true}', 'toCeiling'],
    ['{id: a, shape: box, size: [1, 1, 1], pose: [0, 0, 0, 0.1, 0, 0], to_ceiling: true}', 'toCeiling'],
    ['{id: ground, shape: sphere, size: [1]}', 'takenId'],
    ['{id: a b, shape: sphere, size: [1]}', 'name'],
    ['{id: a, shape: sphere, size: [1], pose: [0, 0, 0]}', 'exactly'],
    ['{id: a, shape: sphere, size: [1], restitution: 2}', 'range'],
    ['{shape: sphere, size: [1]}', 'missing'],
    ['{id: a, shape: sphere, size: [1], texture: marble}', 'texture'],
    ['{id: a, shape: sphere, size: [1], tile: [1, 1]}', 'tile'],
    ['{id: a, shape: sphere, size: [1], texture: wood, tile: [0, 1]}', 'above'],
    ['{id: a, shape: sdf, file: a.sdf, texture: wood}', 'noTexture'],
  ])('refuses %s', (model, kind) => {
    const text = `format: bt-studio/universe\nversion: 1\nname: x\nmodels:\n  - ${model}\n`;
    expect(problemsOf(text)).toContainEqual([kind, 5]);
  });

  it('reads a ceiling, whose name is then taken', () => {
    const text = 'format: bt-studio/universe\nversion: 1\nname: x\nceiling: {height: 3}\nmodels:\n';
    const walls = '  - {id: ceiling, shape: box, size: [1, 1, 1], to_ceiling: true}\n';
    const [wall] = universeOf(text + walls).things;
    expect(universeOf(text + walls).ceiling).toMatchObject({ height: 3, color: '#e8e6e0', texture: '' });
    expect(wall).toMatchObject({ to_ceiling: true });
    expect(problemsOf(text + walls)).toContainEqual(['takenId', 6]);
    expect(universeOf(ROOM).ceiling).toBeNull();
  });

  it('adds a ceiling if there was none', () => {
    const inside = edited(ROOM, (universe) => setWorld(universe, ['ceiling', 'height'], 2.5));
    expect(universeOf(inside).ceiling?.height).toBe(2.5);
    expect(problemsOf(inside)).toEqual([]);
  });

  it('has a robot for a document without robots', () => {
    expect(universeOf(ROOM).things.at(-1)).toMatchObject({ section: 'robots', model: 'turtle2' });
  });
});

describe('rewriting', () => {
  const lines = (text: string) => text.split('\n');

  it('changes only the changed numbers, and no other byte', () => {
    const moved = edited(ROOM, (universe) => move(universe, ['north', 'walker'], [1, -1, 0]));
    const wanted = ROOM.replace('pose: [0, 5, 0.50', 'pose: [1, 4, 0.50').replace(
      '[[1, 0], [3, 2], [0, 3]]',
      '[[2, -1], [4, 1], [1, 2]]',
    );
    expect(moved).toBe(wanted);
  });

  it('adds and removes fields in the style of the thing', () => {
    const heavy = edited(ROOM, (universe) => setField(universe, 'ball', 'mass', 0.4));
    expect(heavy).toBe(ROOM.replace('0.1, 0, 0, 0]}', '0.1, 0, 0, 0], mass: 0.4}'));
    const bouncy = edited(ROOM, (universe) => setField(universe, 'crate', 'restitution', 0.5));
    expect(bouncy).toBe(ROOM.replace('mass: 2.0\n', 'mass: 2.0\n    restitution: 0.5\n'));
    expect(edited(heavy, (universe) => setField(universe, 'ball', 'mass', undefined))).toBe(ROOM);
    expect(edited(bouncy, (universe) => setField(universe, 'crate', 'restitution', undefined))).toBe(ROOM);
  });

  it('adds things at the end of their list, and takes whole lines out', () => {
    const box = { id: 'box', shape: 'box', size: [1, 1, 1], pose: [0, 0, 0.5, 0, 0, 0] };
    const more = edited(ROOM, (universe) => add(universe, 'models', [box]));
    const added = '  - {id: box, shape: box, size: [1, 1, 1], pose: [0, 0, 0.5, 0, 0, 0]}';
    expect(lines(more).filter((line) => !lines(ROOM).includes(line))).toEqual([added]);
    expect(edited(more, (universe) => remove(universe, ['box']))).toBe(ROOM);
    const less = edited(ROOM, (universe) => remove(universe, ['crate']));
    expect(less).not.toContain('crate');
    expect(lines(less).every((line) => lines(ROOM).includes(line) || line.startsWith('random:'))).toBe(true);
    const none = edited(ROOM, (universe) => remove(universe, ['north', 'crate', 'ball']));
    expect(none).toContain('models: []\n  # Walls');
    expect(none).not.toContain('random');
    expect(edited(none, (universe) => add(universe, 'models', [box]))).toContain(added);
  });

  it('writes the implied robot before it changes it', () => {
    const moved = edited(ROOM, (universe) => move(universe, ['robot'], [1, 2, 0]));
    expect(moved).toBe(`${ROOM}robots:\n  - {id: robot, model: turtle2, pose: [1, 2, 0, 0, 0, 0]}\n`);
  });

  it('rewrites documents that it cannot splice, with comments', () => {
    const odd = 'format: bt-studio/universe\nversion: 1 # one\nname: x\nmodels:\nactors: # none\n';
    const box = { id: 'box', shape: 'sphere', size: [1] };
    const written = edited(odd, (universe) => add(universe, 'models', [box]));
    expect(written).toContain('# one');
    expect(universeOf(written).things[0]?.id).toBe('box');
  });

  it('throws if a document cannot be changed piece by piece', () => {
    const shared = ROOM.replace('[2, 1, 0.3', '&p [2, 1, 0.3').replace('[1, 1, 0.1, 0, 0, 0]', '*p');
    expect(() => edited(shared, (universe) => move(universe, ['crate'], [1, 0, 0]))).toThrow(UnwritableError);
  });
});

describe('edits', () => {
  it('renames a thing also in `random`, and refuses a taken name', () => {
    const text = edited(ROOM, (universe) => rename(universe, 'crate', 'chest'));
    expect(text).toContain('id: chest      # in block style');
    expect(text).toContain('chest.pose.x: [1, 3]');
    expect(readUniverse(text).problems).toEqual([]);
    expect(rename(universeOf(ROOM), 'crate', 'ball').ops).toEqual([]);
    expect(rename(universeOf(ROOM), 'crate', 'a b').ops).toEqual([]);
  });

  it('copies under free names, and selects the copies', () => {
    const edit = duplicate(universeOf(ROOM), ['ball', 'walker', 'robot'], [0.5, 0.5]);
    expect(edit.select).toEqual(['ball_2', 'walker_2', 'robot_2']);
    const after = universeOf(rewrite(ROOM, edit.ops));
    expect(after.things.map(({ id }) => id)).toEqual([
      'north',
      'crate',
      'ball',
      'ball_2',
      'walker',
      'walker_2',
      'robot',
      'robot_2',
    ]);
  });

  it('changes paths, point by point, and keeps the last point', () => {
    let text = edited(ROOM, (universe) => addWaypoint(universe, 'walker', 1, [9, 9]));
    text = edited(text, (universe) => setWaypoint(universe, 'walker', 0, [5, 5]));
    text = edited(text, (universe) => removeWaypoint(universe, 'walker', 3));
    expect(text).toContain('path: [[5, 5], [3, 2], [9, 9]]');
    const lonely = ROOM.replace('[[1, 0], [3, 2], [0, 3]]', '[[1, 0]]');
    expect(removeWaypoint(universeOf(lonely), 'walker', 0).ops).toEqual([]);
  });

  it('sets properties of the world itself, whether they existed or not', () => {
    expect(edited(ROOM, (universe) => setWorld(universe, ['ground', 'color'], '#112233'))).toBe(
      ROOM.replace('#d8d4cc', '#112233'),
    );
    const lit = edited(ROOM, (universe) => setWorld(universe, ['lights', 0, 'intensity'], 2));
    expect(universeOf(lit).lights).toEqual([{ direction: [0.3, 0.4, -0.8], intensity: 2 }]);
    const seen = edited(ROOM, (universe) => setWorld(universe, ['view', 'eye'], [1, 2, 3]));
    expect(universeOf(seen).view.eye).toEqual([1, 2, 3]);
  });

  it('stretches along the axes of a shape', () => {
    expect(stretched('box', [1, 1, 1], [2, 1, 1], 0.1)).toEqual([2, 1, 1]);
    expect(stretched('cylinder', [1, 1], [1, 1.5, 2], 0)).toEqual([1.5, 2]);
    expect(stretched('sphere', [1], [1, 1, 0.5], 0.1)).toEqual([0.5]);
    expect(stretched('plane', [1, 1], [0.001, 1, 1], 0.1)).toEqual([0.1, 1]);
    expect(wallBetween([0, 0], [0, 2])).toEqual({ middle: [0, 1], length: 2, yaw: 1.5708 });
  });
});

/** Edits that a user may make, in any order, on any things. */
const gesture = fc.tuple(
  fc.nat(8),
  fc.nat(9),
  fc.integer({ min: -50, max: 50 }),
  fc.integer({ min: 1, max: 90 }),
);

function editOf(universe: Universe, [kind, pick, a, b]: readonly [number, number, number, number]): Edit {
  const keys = universe.things.map(({ key }) => key);
  const key = keys[pick % Math.max(keys.length, 1)] ?? 'none';
  const other = keys[(pick + 1) % Math.max(keys.length, 1)] ?? 'none';
  const chosen = key === other ? [key] : [key, other];
  switch (kind) {
    case 0:
      return move(universe, chosen, [a / 10, b / 10, 0]);
    case 1:
      return turn(universe, chosen, a / 10, [b / 10, 0]);
    case 2:
      return remove(universe, chosen);
    case 3:
      return duplicate(universe, chosen, [0.5, a / 10]);
    case 4:
      return rename(universe, key, `t${b}`);
    case 5:
      return setField(universe, key, 'color', `#0000${b}`);
    case 6:
      return add(universe, 'models', [{ id: `m${a + 50}_${b}`, shape: 'box', size: [1, b / 10, 1] }]);
    case 7:
      return addWaypoint(universe, 'walker', 0, [a / 10, b / 10]);
    default:
      return setWorld(universe, ['ground', 'friction'], b / 100);
  }
}

describe('any sequence of edits', () => {
  const texts = fc.constantFrom(
    ROOM,
    ...builtins.filter(([, text]) => text.length < 4000).map(([, text]) => text),
  );

  it('changes text and value alike, and undoes to the byte', () => {
    fc.assert(
      fc.property(texts, fc.array(gesture, { maxLength: 8 }), (start, gestures) => {
        let undoStack = startUndo([start]);
        for (const each of gestures) {
          const universe = universeOf(undoStack.texts[0]!);
          const { ops } = editOf(universe, each);
          const text = rewrite(undoStack.texts[0]!, ops);
          expect(sameValue(universeOf(text).raw, applyOps(universe.raw, ops))).toBe(true);
          undoStack = seal(record(undoStack, [text], { label: 'x', mergeKey: null, before: [], after: [] }));
        }
        const end = undoStack.texts[0];
        let steps = 0;
        for (let back: TextUndo | null = undo(undoStack); back; back = undo(back)) {
          undoStack = back;
          steps += 1;
        }
        expect(undoStack.texts[0]).toBe(start);
        for (; steps > 0; steps -= 1) undoStack = redo(undoStack) ?? undoStack;
        expect(undoStack.texts[0]).toBe(end);
      }),
      { numRuns: 30 },
    );
  });

  it('keeps every comment', () => {
    const comments = (text: string) => text.match(/# [A-Z].*$/gm) ?? [];
    fc.assert(
      fc.property(texts, gesture, (start, each) => {
        const after = rewrite(start, editOf(universeOf(start), each).ops);
        expect(comments(after)).toEqual(comments(start));
      }),
      { numRuns: 30 },
    );
  });

  it('splices there and back', () => {
    fc.assert(
      fc.property(fc.string(), fc.string(), (before, after) => {
        const splice = difference(before, after);
        expect(spliced(before, splice)).toBe(after);
        expect(spliced(after, inverse(splice))).toBe(before);
      }),
    );
  });

  it('joins steps of one gesture until it is sealed', () => {
    const step = { label: 'x', mergeKey: 'drag', before: ['a'], after: ['b'] };
    let undoStack = record(record(startUndo(['1']), ['12'], step), ['123'], step);
    expect(undoStack.past).toHaveLength(1);
    undoStack = record(seal(undoStack), ['1234'], step);
    expect(undoStack.past).toHaveLength(2);
    expect(undo(undo(undoStack)!)?.texts).toEqual(['1']);
  });
});
