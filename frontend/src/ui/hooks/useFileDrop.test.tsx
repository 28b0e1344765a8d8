import { cleanup, createEvent, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { show } from '../../../harness/testing';
import { useFileDrop } from './useFileDrop';

const file = new File(['x'], 'project.zip');
const onDrop = vi.fn();

function Page() {
  return <p>{useFileDrop(onDrop) ? 'over' : 'away'}</p>;
}

const files = { types: ['Files'], files: [file] };
const words = { types: ['text/plain'], files: [] };
const state = () => screen.getByText(/over|away/).textContent;
/** Fires a drag event; returns whether the page handled it. */
const fire = (type: 'dragOver' | 'drop', dataTransfer?: object) => !fireEvent[type](window, { dataTransfer });

function leave(to: Element | null): void {
  const event = createEvent.dragLeave(window);
  Object.defineProperty(event, 'relatedTarget', { value: to });
  fireEvent(window, event);
}

beforeEach(() => {
  onDrop.mockClear();
  show(<Page />);
});

describe('useFileDrop', () => {
  it('shows that files are over the page, and accepts the first', () => {
    expect(state()).toBe('away');
    expect(fire('dragOver', files)).toBe(true);
    expect(state()).toBe('over');
    expect(fire('drop', files)).toBe(true);
    expect(state()).toBe('away');
    expect(onDrop).toHaveBeenCalledExactlyOnceWith(file, files);
  });

  it('resets when the files leave', () => {
    fire('dragOver', files);
    leave(document.body);
    expect(state()).toBe('over');
    leave(null);
    expect(state()).toBe('away');
  });

  it('leaves text, and empty drags, to the browser', () => {
    expect(fire('dragOver', words)).toBe(false);
    expect(fire('drop', words)).toBe(false);
    expect(fire('dragOver')).toBe(false);
    expect(state()).toBe('away');
    expect(fire('drop', { types: ['Files'], files: [] })).toBe(true);
    expect(onDrop).not.toHaveBeenCalled();
  });
});

it('accepts nothing after it is unmounted', () => {
  cleanup();
  expect(fire('dragOver', files)).toBe(false);
  expect(fire('drop', files)).toBe(false);
  expect(onDrop).not.toHaveBeenCalled();
});
