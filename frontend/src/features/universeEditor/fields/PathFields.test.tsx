import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { HALL, lookOnly, openUniverse, showUniverse, write } from '../../../../harness/documents';
import { user } from '../../../../harness/testing';
import { PathFields } from './PathFields';

const AREAS = `${HALL}areas:\n  door: {box: [1, 2, 3, 4]}\n`;

function fields(isLooking = false) {
  const editor = openUniverse(AREAS);
  if (isLooking) lookOnly();
  const shown = showUniverse(editor, (universe) => {
    const thing = universe.things.find(({ id }) => id === 'door');
    return thing?.section === 'areas' ? <PathFields editor={editor} thing={thing} /> : null;
  });
  return { editor, ...shown };
}

describe('the corners of an area', () => {
  it('are numbers, and a box stays one', async () => {
    const { thing } = fields();
    await write(screen.getByRole('textbox', { name: 'x 3' }), '5');
    expect(thing('door')).toMatchObject({
      shape: 'box',
      path: [
        [1, 2],
        [5, 2],
        [5, 4],
        [1, 4],
      ],
    });
  });

  it('are added after the selected one, and removed down to three', async () => {
    const { editor, thing } = fields();
    await user.click(screen.getByRole('button', { name: 'Corner 2 of the area' }));
    await user.click(screen.getByRole('button', { name: 'Add a corner' }));
    expect(thing('door')).toMatchObject({
      shape: 'polygon',
      path: [
        [1, 2],
        [3, 2],
        [3, 3],
        [3, 4],
        [1, 4],
      ],
    });
    expect(editor.store.getState().waypoint).toBe(2);
    const remove = () => screen.getAllByRole('button', { name: 'Remove this corner' });
    await user.click(remove()[2]!);
    await user.click(remove()[0]!);
    expect(remove()).toHaveLength(3);
    for (const button of remove()) expect(button).toBeDisabled();
  });

  it('cannot be changed by those who look', () => {
    fields(true);
    expect(screen.getByTestId('add-waypoint')).toBeDisabled();
  });
});
