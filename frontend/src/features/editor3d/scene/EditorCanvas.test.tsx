import { fireEvent, screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show } from '../../../../harness/testing';
import { EditorCanvas } from './EditorCanvas';

function canvas() {
  const onKey = vi.fn();
  const stage = vi.fn(() => null);
  show(
    <EditorCanvas
      label="The hall"
      noWebGl="No 3D here"
      testId="view"
      count={3}
      near={0.1}
      onKey={onKey}
      stage={stage}
    >
      <button>inside</button>
    </EditorCanvas>,
  );
  return { view: screen.getByTestId('view'), onKey, stage };
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
});
