import { fireEvent, screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show } from '../../../../harness/testing';
import { DRAGGED } from '../PlaceButton';
import { EditorCanvas } from './EditorCanvas';

function canvas() {
  const onKey = vi.fn();
  const onDropped = vi.fn();
  const stage = vi.fn(() => null);
  show(
    <EditorCanvas
      label="The hall"
      noWebGl="No 3D here"
      testId="view"
      count={3}
      near={0.1}
      onKey={onKey}
      onDropped={onDropped}
      stage={stage}
    >
      <button>inside</button>
    </EditorCanvas>,
  );
  return { view: screen.getByTestId('view'), onKey, onDropped, stage };
}

describe('the view of an editor without WebGL', () => {
  it('is still a control with a description', () => {
    const { view, stage } = canvas();
    expect(view).toHaveAttribute('role', 'application');
    expect(view).toHaveAccessibleName('The hall');
    expect(view).toHaveAttribute('data-things', '3');
    expect(view.tabIndex).toBe(0);
    expect(screen.getByRole('note')).toHaveTextContent('No 3D here');
    expect(view.querySelector('canvas')).toBeNull();
    expect(stage).not.toHaveBeenCalled();
  });

  it('handles keys on itself, not those of elements above it', () => {
    const { view, onKey } = canvas();
    fireEvent.keyDown(view, { key: 'q' });
    expect(onKey).toHaveBeenCalledOnce();
    fireEvent.keyDown(screen.getByRole('button'), { key: 'q' });
    expect(onKey).toHaveBeenCalledOnce();
  });

  it('accepts only things of the palette', () => {
    const { view } = canvas();
    const over = (type: string) => !fireEvent.dragOver(view, { dataTransfer: { types: [type] } });
    expect(over(DRAGGED)).toBe(true);
    expect(over('text/plain')).toBe(false);
  });

  it('has no floor where something could be dropped', () => {
    const { view, onDropped } = canvas();
    fireEvent.drop(view, { dataTransfer: { getData: () => '{"kind":"box"}' } });
    expect(onDropped).not.toHaveBeenCalled();
  });
});
