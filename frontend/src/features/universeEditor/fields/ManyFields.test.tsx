import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import { openUniverse, showUniverse } from '../../../../harness/documents';
import { user } from '../../../../harness/testing';
import { ManyFields } from './ManyFields';

describe('the fields of several things', () => {
  it('show how many there are', () => {
    const editor = openUniverse();
    showUniverse(editor, () => <ManyFields editor={editor} count={3} />);
    expect(screen.getByText('3 things are selected.')).toBeInTheDocument();
    expect(screen.getByText(/They move and turn together/)).toBeInTheDocument();
  });

  it('set the colour of all except robots, one undo step each', async () => {
    const editor = openUniverse();
    select(editor, ['crate', 'walker', 'robot']);
    const { thing, universe } = showUniverse(editor, () => <ManyFields editor={editor} count={3} />);
    const color = screen.getByRole('textbox', { name: 'Colour' });
    for (const wish of ['#010203', '#040506']) {
      await user.clear(color);
      await user.type(color, wish);
    }
    expect(color).toHaveValue('#040506');
    expect(thing('crate')).toMatchObject({ color: '#040506' });
    expect(thing('walker')).toMatchObject({ color: '#040506' });
    expect(thing('ball')).toMatchObject({ color: '#e2543c' });
    expect(JSON.stringify(universe().raw['robots'])).not.toContain('color');
    expect(editor.store.getState().undoStack.past).toHaveLength(2);
    act(() => {
      color.blur();
    });
    expect(editor.store.getState()).toMatchObject({
      selection: ['crate', 'walker', 'robot'],
      undoStack: { sealed: true },
    });
  });
});
