import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { choose, HALL, lookOnly, openUniverse, showUniverse, write } from '../../../../harness/documents';
import { user } from '../../../../harness/testing';
import { ModelFields } from './ModelFields';

const CHAIR = '{id: chair, shape: mesh, file: assets/chair.stl, size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0]}';
const MODELS = `models:
  - {id: crate, shape: box, size: [0.4, 0.4, 0.4], pose: [1, 2, 0.2, 0, 0, 0], texture: wood, tile: [1, 2]}
  - {id: tilted, shape: box, size: [1, 1, 1], pose: [1, 2, 3, 0.5, 0, 0]}
  - {id: pitched, shape: box, size: [1, 1, 1], pose: [1, 2, 3, 0, 0.5, 0]}
  - {id: post, shape: box, size: [1, 1, 1], pose: [1, 2, 0.5, 0, 0, 0], to_ceiling: true}
  - {id: ball, shape: sphere, size: [0.12], pose: [0, 0, 0.12, 0, 0, 0], mass: 0.4, restitution: 0.2}
  - {id: ghost, shape: box, size: [1, 1, 1], pose: [1, 2, 0.5, 0, 0, 0], solid: false}
  - ${CHAIR}
  - {id: arm, shape: urdf, file: models/arm.urdf, pose: [0, 0, 0, 0, 0, 0]}
`;

function fieldsOf(id: string, prepare: () => void = () => undefined) {
  const others = { 'assets/chair.stl': '', 'assets/desk.OBJ': '', 'models/arm.urdf': '', 'notes.md': '' };
  const editor = openUniverse(HALL.replace(/models:[^]*actors/, `${MODELS}actors`), others);
  prepare();
  const shown = showUniverse(editor, (universe) => {
    const thing = universe.things.find((each) => each.id === id);
    return thing?.section === 'models' ? <ModelFields editor={editor} thing={thing} /> : null;
  });
  return { editor, ...shown };
}

const box = (name: string) => screen.getByRole('textbox', { name });
const toggle = (name: string) => screen.getByRole('switch', { name });

describe('the fields of a model', () => {
  it('change its place, size and friction', async () => {
    const { thing } = fieldsOf('crate');
    await write('field-z', '1');
    await write('field-size-0', '2');
    await write(box('Friction'), '0.9');
    expect(thing('crate')).toMatchObject({ pose: [1, 2, 1, 0, 0, 0], size: [2, 0.4, 0.4], friction: 0.9 });
    await write(box('Friction'), '11');
    await write('field-size-0', '0');
    expect(thing('crate')).toMatchObject({ size: [0.001, 0.4, 0.4], friction: 10 });
    expect(screen.getByText('Size (m)')).toBeInTheDocument();
  });

  it('set another texture; without one, the size of its repetition is removed', async () => {
    const { thing } = fieldsOf('crate');
    await choose(screen.getByRole('combobox', { name: 'Texture' }), 'Brick');
    expect(thing('crate')).toMatchObject({ texture: 'brick', tile: [1, 2] });
    await choose(screen.getByRole('combobox', { name: 'Texture' }), 'None');
    expect(thing('crate')).toMatchObject({ texture: '', tile: null });
  });

  it('set the colour, one undo step each', async () => {
    const { editor, thing } = fieldsOf('ball');
    const color = box('Colour');
    await user.clear(color);
    await user.type(color, '#112233');
    expect(thing('ball')).toMatchObject({ color: '#112233' });
    await user.clear(color);
    await user.type(color, '#445566');
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
    act(() => {
      color.blur();
    });
    expect(editor.store.getState().undoStack.sealed).toBe(true);
  });

  it('give it a mass, and then show mass and bounce', async () => {
    const { thing } = fieldsOf('crate');
    expect(screen.queryByRole('textbox', { name: 'Mass (kg)' })).toBeNull();
    expect(screen.queryByRole('textbox', { name: 'Bounce' })).toBeNull();
    await user.click(toggle('Movable'));
    expect(thing('crate')).toMatchObject({ mass: 1 });
    expect(toggle('Solid')).toBeDisabled();
    expect(screen.queryByRole('switch', { name: 'Up to the ceiling' })).toBeNull();
    await write(box('Mass (kg)'), '3');
    await write(box('Bounce'), '2');
    expect(thing('crate')).toMatchObject({ mass: 3, restitution: 1 });
    await user.click(toggle('Movable'));
    expect(thing('crate')).toMatchObject({ mass: 0 });
  });

  it('make it permeable, and then hide friction and mass', async () => {
    const { thing } = fieldsOf('crate');
    await user.click(toggle('Solid'));
    expect(thing('crate')).toMatchObject({ solid: false });
    expect(screen.queryByRole('textbox', { name: 'Friction' })).toBeNull();
    expect(toggle('Movable')).toBeDisabled();
    await user.click(toggle('Solid'));
    expect(thing('crate')).toMatchObject({ solid: true });
    expect(toggle('Movable')).toBeEnabled();
  });

  it.each([
    ['crate', true],
    ['tilted', false],
    ['pitched', false],
    ['ball', false],
    ['post', true],
    ['chair', false],
  ])('offer to reach the ceiling only for upright boxes: %s', (id, can) => {
    fieldsOf(id);
    expect(screen.queryByRole('switch', { name: 'Up to the ceiling' }) !== null).toBe(can);
  });

  it('make a box reach the ceiling, which then cannot move', async () => {
    const { thing } = fieldsOf('crate');
    await user.click(toggle('Up to the ceiling'));
    expect(thing('crate')).toMatchObject({ to_ceiling: true });
    expect(toggle('Movable')).toBeDisabled();
    await user.click(toggle('Up to the ceiling'));
    expect(thing('crate')).toMatchObject({ to_ceiling: false });
  });

  it('give a mesh another file and a scale', async () => {
    const { thing } = fieldsOf('chair');
    expect(screen.getByText('Scale')).toBeInTheDocument();
    const file = screen.getByRole('combobox', { name: 'File' });
    await user.click(file);
    expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual(
      expect.arrayContaining(['assets/chair.stl', 'assets/desk.OBJ']),
    );
    expect(screen.queryByRole('option', { name: 'notes.md' })).toBeNull();
    await user.click(screen.getByRole('option', { name: 'assets/desk.OBJ' }));
    expect(thing('chair')).toMatchObject({ file: 'assets/desk.OBJ' });
  });

  it('leave colours and size of a model to its file', () => {
    fieldsOf('arm');
    expect(screen.queryByRole('textbox', { name: 'Colour' })).toBeNull();
    expect(screen.queryByRole('combobox', { name: 'Texture' })).toBeNull();
    expect(screen.queryByTestId('field-size-0')).toBeNull();
    expect(screen.getByRole('combobox', { name: 'File' })).toHaveValue('models/arm.urdf');
  });

  it('cannot be edited in a read-only project', () => {
    fieldsOf('crate', lookOnly);
    for (const name of ['Movable', 'Solid', 'Up to the ceiling']) expect(toggle(name)).toBeDisabled();
    expect(screen.getByTestId('field-x')).toBeDisabled();
    expect(screen.getByRole('combobox', { name: 'Texture' })).toBeDisabled();
  });
});
