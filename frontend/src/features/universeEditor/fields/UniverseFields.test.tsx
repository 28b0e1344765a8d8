import { screen, within } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { choose, HALL, lookOnly, openUniverse, showUniverse, write } from '../../../../harness/documents';
import { user } from '../../../../harness/testing';
import { UniverseFields } from './UniverseFields';

function fields(text = HALL) {
  const editor = openUniverse(text);
  return { editor, ...showUniverse(editor, (now) => <UniverseFields editor={editor} universe={now} />) };
}

const box = (name: string) => screen.getByRole('textbox', { name });
const textures = () => screen.getAllByRole('combobox', { name: 'Texture' });

describe('the fields of a universe', () => {
  it('name and describe it', async () => {
    const { universe } = fields();
    await write(box('Name of the world'), 'Lab');
    await write(box('Description'), 'Two rooms');
    expect(universe()).toMatchObject({ name: 'Lab', description: 'Two rooms' });
  });

  it('refuse a name of more than 120 letters', async () => {
    const { universe } = fields();
    await user.clear(box('Name of the world'));
    await user.paste('a'.repeat(121));
    expect(box('Name of the world')).toBeInvalid();
    await user.keyboard('{Enter}');
    expect(universe().name).toBe('Hall');
    await user.clear(box('Name of the world'));
    await user.paste('a'.repeat(120));
    await user.keyboard('{Enter}');
    expect(universe().name).toHaveLength(120);
  });

  it('colour the ground, and cover it with a texture', async () => {
    const { universe } = fields(`${HALL}ground: {texture: wood, tile: [1, 1]}\n`);
    await user.clear(box('Colour of the ground'));
    await user.type(box('Colour of the ground'), '#102030');
    await write(box('Friction'), '-1');
    expect(universe().ground).toMatchObject({ color: '#102030', friction: 0, tile: [1, 1] });
    await choose(textures()[0]!, 'Grass');
    expect(universe().ground).toMatchObject({ texture: 'grass', tile: [1, 1] });
    await choose(textures()[0]!, 'None');
    expect(universe().ground).toMatchObject({ texture: '', tile: null });
    await write(box('Friction'), '11');
    expect(universe().ground.friction).toBe(10);
  });

  it('make it indoors, with a ceiling of its own height, colour and texture', async () => {
    const { universe } = fields();
    expect(screen.queryByText(/Robots' cameras see the ceiling/)).toBeNull();
    expect(textures()).toHaveLength(1);
    await user.click(screen.getByRole('switch', { name: 'Indoors' }));
    expect(universe().ceiling).toMatchObject({ height: 2.5 });
    expect(screen.getByText(/Robots' cameras see the ceiling/)).toBeInTheDocument();
    await write(box('Height (m)'), '0');
    expect(universe().ceiling?.height).toBe(0.1);
    await write(box('Height (m)'), '2000');
    expect(universe().ceiling?.height).toBe(1000);
    await user.clear(box('Colour of the ceiling'));
    await user.type(box('Colour of the ceiling'), '#445566');
    await choose(textures()[1]!, 'Tiles');
    expect(universe().ceiling).toMatchObject({ color: '#445566', texture: 'tiles' });
    await choose(textures()[1]!, 'None');
    expect(universe().ceiling).toMatchObject({ texture: '', color: '#445566' });
    await user.click(screen.getByRole('switch', { name: 'Indoors' }));
    expect(universe().ceiling).toBeNull();
  });

  it('turn and weaken the sun', async () => {
    const { universe } = fields();
    const sun = within(screen.getByRole('group', { name: 'Sun: direction and strength' }));
    await write(sun.getByRole('textbox', { name: 'y' }), '0.7');
    await write(sun.getByRole('textbox', { name: 'strength' }), '3');
    expect(universe().lights).toEqual([{ direction: [-0.4, 0.7, -1], intensity: 3 }]);
    await write(sun.getByRole('textbox', { name: 'strength' }), '12');
    expect(universe().lights[0]?.intensity).toBe(10);
    await write(sun.getByRole('textbox', { name: 'strength' }), '-1');
    expect(universe().lights[0]?.intensity).toBe(0);
  });

  it('offer no sun if there is none', () => {
    fields(HALL.replace(/lights: .*\n/, 'lights: []\n'));
    expect(screen.queryByText('Sun: direction and strength')).toBeNull();
    expect(screen.getByText('Select a thing to change it.')).toBeInTheDocument();
  });

  it('cannot be edited in a read-only project', () => {
    const editor = openUniverse();
    lookOnly();
    showUniverse(editor, (now) => <UniverseFields editor={editor} universe={now} />);
    expect(screen.getByRole('switch', { name: 'Indoors' })).toBeDisabled();
    expect(box('Name of the world')).toBeDisabled();
    expect(box('Friction')).toBeDisabled();
    expect(box('Colour of the ground')).toBeDisabled();
  });
});
