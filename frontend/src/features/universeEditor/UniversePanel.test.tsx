import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { useProjectStore } from '@/store/project';
import { type as typeInto, write as writeInto } from '../../../harness/documents';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { editorOf, readingOf, type UniverseEditor } from './editor';
import { UniversePanel } from './UniversePanel';

const PATH = 'universes/hall.yaml';
const HALL = `format: bt-studio/universe
version: 1
name: Hall
ground: {color: "#808080", friction: 0.9}
lights: [{direction: [-0.4, 0.3, -1], intensity: 1}]
models:
  - {id: crate, shape: box, size: [0.4, 0.4, 0.4], pose: [1, 2, 0.2, 0, 0, 0], color: "#c28a52"}
  - {id: floor, shape: plane, size: [2, 2], pose: [0, 0, 0, 0, 0, 0], color: "#b8c4cf", solid: false}
actors:
  - {id: walker, model: person, color: "#20c020", path: [[0, 0], [2, 0]], speed: 0.5, loop: true}
`;

let editor: UniverseEditor;
let runs = 0;

/** The panel, with the current document. */
function Panel() {
  useProjectStore((state) => state.files[PATH]?.text);
  const { universe } = readingOf(editor);
  return universe ? <UniversePanel editor={editor} universe={universe} /> : null;
}

const universe = () => readingOf(editor).universe!;
const thing = (id: string) => universe().things.find((each) => each.id === id);
const field = (label: string | RegExp) => screen.getByRole('textbox', { name: label });

const type = (label: string | RegExp, text: string) => typeInto(field(label), text);
const write = (label: string | RegExp, text: string) => writeInto(field(label), text);
const choose = (id: string) => {
  act(() => {
    select(editor, [thing(id)!.key]);
  });
};

beforeEach(() => {
  fakeServer({ 'GET /catalog/robots': [], 'GET /catalog/universes': [] });
  openProject({ texts: { [PATH]: HALL } });
  // An editor outlives its tab but belongs to one project, so each test needs a new project.
  useProjectStore.setState({ projectId: `p${(runs += 1)}` });
  editor = editorOf(PATH);
  show(<Panel />);
});

describe('the fields of a universe', () => {
  it('name it', async () => {
    await write('Name of the world', 'Big hall');
    expect(universe().name).toBe('Big hall');
    await type('Name of the world', ' ');
    expect(screen.getByText('Must not be empty')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(universe().name).toBe('Big hall');
  });

  it('keep the friction of the ground in its range', async () => {
    await write('Friction', '0.5');
    expect(universe().ground.friction).toBe(0.5);
    await write('Friction', '99');
    expect(universe().ground.friction).toBe(10);
  });

  it('step a number with the arrows', async () => {
    await user.type(field('Friction'), '{ArrowUp}');
    expect(universe().ground.friction).toBe(1);
    await user.type(field('Friction'), '{Shift>}{ArrowDown}{/Shift}');
    expect(universe().ground.friction).toBe(0);
  });

  it('add a ceiling, change its height and remove it', async () => {
    await user.click(screen.getByTestId('field-ceiling'));
    expect(universe().ceiling?.height).toBe(2.5);
    await writeInto('field-ceiling-height', '3');
    expect(universe().ceiling?.height).toBe(3);
    await user.click(screen.getByTestId('field-ceiling'));
    expect(universe().ceiling).toBeNull();
  });

  it('turn the sun, but never without a direction', async () => {
    await write('x', '0');
    await write('y', '0');
    await write('z', '0');
    expect(universe().lights[0]?.direction).toEqual([0, 0, -1]);
  });
});

describe('the fields of a thing', () => {
  beforeEach(() => {
    choose('crate');
  });

  it('rename it, and refuse a taken or bad name', async () => {
    await type(/^Name/, 'floor');
    expect(screen.getByText('The name floor is used twice')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(thing('crate')).toBeDefined();
    await type(/^Name/, '3d');
    expect(field(/^Name/)).toBeInvalid();
    await user.type(field(/^Name/), '{Escape}');
    expect(field(/^Name/)).toHaveValue('crate');
    await write(/^Name/, 'chest');
    expect(thing('chest')).toBeDefined();
    expect(thing('crate')).toBeUndefined();
  });

  it('move and turn it', async () => {
    await writeInto('field-x', '3.5');
    await writeInto('field-yaw', '90');
    const moved = thing('crate');
    expect(moved).toMatchObject({ section: 'models' });
    expect(moved?.section === 'models' && moved.pose.map((part) => Math.round(part * 100) / 100)).toEqual([
      3.5, 2, 0.2, 0, 0, 1.57,
    ]);
  });

  it('keep it on the floor when its height changes', async () => {
    await writeInto('field-size-2', '1');
    expect(thing('crate')).toMatchObject({ size: [0.4, 0.4, 1], pose: [1, 2, 0.5, 0, 0, 0] });
  });

  it('give it a mass, and then show the fields of a mass', async () => {
    expect(screen.queryByTestId('field-mass')).toBeNull();
    await user.click(screen.getByTestId('field-dynamic'));
    expect(thing('crate')).toMatchObject({ mass: 1 });
    expect(screen.queryByTestId('field-to-ceiling')).toBeNull();
    await writeInto('field-mass', 'heavy');
    expect(thing('crate')).toMatchObject({ mass: 1 });
    await writeInto('field-mass', '4');
    expect(thing('crate')).toMatchObject({ mass: 4 });
  });

  it('offer a mass only for a solid thing', () => {
    choose('floor');
    expect(screen.getByTestId('field-dynamic')).toBeDisabled();
  });
});

describe('the fields of a person', () => {
  beforeEach(() => {
    choose('walker');
  });

  it('change the path, point by point', async () => {
    await write('x 2', '3');
    expect(thing('walker')).toMatchObject({
      path: [
        [0, 0],
        [3, 0],
      ],
    });
    await user.click(screen.getByTestId('add-waypoint'));
    expect(thing('walker')).toMatchObject({
      path: [
        [0, 0],
        [3, 0],
        [1.5, 0],
      ],
    });
  });
});
