import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { HALL, lookOnly, openUniverse, showUniverse, write } from '../../../../harness/documents';
import { user } from '../../../../harness/testing';
import { ActorFields } from './ActorFields';

function fields(text = HALL) {
  const editor = openUniverse(text);
  const shown = showUniverse(editor, (universe) => {
    const thing = universe.things.find(({ id }) => id === 'walker');
    return thing?.section === 'actors' ? <ActorFields editor={editor} thing={thing} /> : null;
  });
  return { editor, ...shown };
}

const box = (name: string) => screen.getByRole('textbox', { name });

describe('the fields of a person', () => {
  it('change the speed and the start, within their ranges', async () => {
    const { thing } = fields();
    await write(box('Speed (m/s)'), '1.2');
    await write(box('Starts after (m)'), '0.5');
    expect(thing('walker')).toMatchObject({ speed: 1.2, start_m: 0.5 });
    await write(box('Speed (m/s)'), '7');
    await write(box('Starts after (m)'), '-1');
    expect(thing('walker')).toMatchObject({ speed: 5, start_m: 0 });
    await write(box('Speed (m/s)'), '-1');
    expect(thing('walker')).toMatchObject({ speed: 0 });
  });

  it('make the person walk to and fro instead of in a loop', async () => {
    const { thing } = fields();
    await user.click(screen.getByRole('switch', { name: 'In a loop' }));
    expect(thing('walker')).toMatchObject({ loop: false });
  });

  it('make the person wait for robots in the way', async () => {
    const { thing } = fields();
    await user.click(screen.getByRole('switch', { name: 'Waits for robots' }));
    expect(thing('walker')).toMatchObject({ yields: true });
  });

  it('move points of the path', async () => {
    const { thing } = fields();
    await write(box('x 1'), '-1');
    await write(box('y 3'), '4');
    expect(thing('walker')).toMatchObject({
      path: [
        [-1, 0],
        [2, 0],
        [2, 4],
      ],
    });
  });

  it('select a point, after which the next one is added', async () => {
    const { editor, thing } = fields();
    const second = screen.getByRole('button', { name: 'Point 2 of the path' });
    expect(second).toHaveAttribute('aria-pressed', 'false');
    await user.click(second);
    expect(editor.store.getState()).toMatchObject({ selection: ['walker'], waypoint: 1 });
    expect(second).toHaveAttribute('aria-pressed', 'true');
    expect(second.closest('li')).toHaveAttribute('data-chosen', 'true');
    await user.click(screen.getByRole('button', { name: 'Add a point' }));
    expect(thing('walker')).toMatchObject({ path: [expect.anything(), [2, 0], [2, 1], [2, 2]] });
    expect(editor.store.getState().waypoint).toBe(2);
  });

  it('remove a point, but never the last one', async () => {
    const { editor, thing } = fields();
    const remove = () => screen.getAllByRole('button', { name: 'Remove this point' });
    await user.click(remove()[1]!);
    expect(thing('walker')).toMatchObject({
      path: [
        [0, 0],
        [2, 2],
      ],
    });
    expect(editor.store.getState()).toMatchObject({ selection: ['walker'], waypoint: null });
    await user.click(remove()[0]!);
    expect(remove()).toHaveLength(1);
    expect(remove()[0]).toBeDisabled();
  });

  it('set the colour, one undo step each', async () => {
    const { editor, thing } = fields();
    const color = box('Clothes');
    for (const wish of ['#aabbcc', '#ddeeff']) {
      await user.clear(color);
      await user.type(color, wish);
    }
    expect(thing('walker')).toMatchObject({ color: '#ddeeff' });
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
    act(() => {
      color.blur();
    });
    expect(editor.store.getState()).toMatchObject({ selection: ['walker'], undoStack: { sealed: true } });
  });

  it('cannot be edited in a read-only project', () => {
    const editor = openUniverse();
    lookOnly();
    showUniverse(editor, ({ things }) =>
      things.map((thing) =>
        thing.section === 'actors' ? <ActorFields key={1} editor={editor} thing={thing} /> : null,
      ),
    );
    expect(screen.getByTestId('add-waypoint')).toBeDisabled();
    expect(screen.getByRole('switch', { name: 'In a loop' })).toBeDisabled();
    for (const button of screen.getAllByRole('button', { name: 'Remove this point' }))
      expect(button).toBeDisabled();
  });
});
