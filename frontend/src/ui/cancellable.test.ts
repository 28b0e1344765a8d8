import { createEvent, fireEvent } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { cancellable, releaseMouse } from './cancellable';

const calls = { onMove: vi.fn(), onEnd: vi.fn(), onCancel: vi.fn() };
const press = (pointerId: number | null = 1) => cancellable(document.body, pointerId, calls);
const pointer = (type: 'pointermove' | 'pointerup' | 'pointercancel', pointerId = 1, buttons = 0) => {
  const event = new MouseEvent(type, { bubbles: true, buttons });
  Object.defineProperty(event, 'pointerId', { value: pointerId });
  document.body.dispatchEvent(event);
};

beforeEach(() => {
  vi.clearAllMocks();
  fireEvent.pointerDown(document.body);
});

describe('a gesture', () => {
  it('is followed until the button is released', () => {
    press();
    pointer('pointermove');
    pointer('pointermove', 2);
    pointer('pointerup', 2);
    expect(calls.onMove).toHaveBeenCalledOnce();
    pointer('pointerup');
    pointer('pointermove');
    pointer('pointercancel');
    expect(calls.onMove).toHaveBeenCalledOnce();
    expect(calls.onEnd).toHaveBeenCalledOnce();
    expect(calls.onCancel).not.toHaveBeenCalled();
  });

  it('with mouse events only follows any pointer', () => {
    press(null);
    pointer('pointermove', 7);
    pointer('pointerup', 8);
    expect(calls.onMove).toHaveBeenCalledOnce();
    expect(calls.onEnd).toHaveBeenCalledOnce();
  });

  it.each([
    ['a lost pointer', () => pointer('pointercancel')],
    ['a window without the focus', () => fireEvent.blur(window)],
    ['Escape', () => fireEvent.keyDown(document.body, { key: 'Escape' })],
    ['the right button', () => fireEvent.mouseDown(document.body, { button: 2 })],
    ['a context menu', () => fireEvent.contextMenu(document.body)],
  ])('is cancelled once by %s', (_name, cancel) => {
    press();
    cancel();
    pointer('pointermove');
    pointer('pointerup');
    fireEvent.keyDown(document.body, { key: 'Escape' });
    expect(calls.onCancel).toHaveBeenCalledOnce();
    expect(calls.onMove).not.toHaveBeenCalled();
    expect(calls.onEnd).not.toHaveBeenCalled();
  });

  it('that its owner stops calls no handler', () => {
    press()();
    pointer('pointermove');
    fireEvent.keyDown(document.body, { key: 'Escape' });
    pointer('pointerup');
    for (const call of Object.values(calls)) expect(call).not.toHaveBeenCalled();
  });

  it('survives other keys, the first button, and a field that loses the focus', () => {
    press();
    fireEvent.keyDown(document.body, { key: 'Shift' });
    fireEvent.mouseDown(document.body, { button: 0 });
    fireEvent.blur(document.body);
    expect(calls.onCancel).not.toHaveBeenCalled();
    pointer('pointerup');
  });
});

describe('after a cancelled gesture', () => {
  it('neither the key nor the menu reaches anything else', () => {
    const key = vi.fn();
    document.body.addEventListener('keydown', key);
    press();
    expect(fireEvent.keyDown(document.body, { key: 'Escape' })).toBe(false);
    expect(key).not.toHaveBeenCalled();
    expect(fireEvent.contextMenu(document.body)).toBe(false);
    document.body.removeEventListener('keydown', key);
  });

  it('the click of the released button is suppressed, a later one is not', async () => {
    const click = vi.fn();
    document.body.addEventListener('click', click);
    press();
    fireEvent.keyDown(document.body, { key: 'Escape' });
    pointer('pointerup', 1, 1);
    fireEvent.click(document.body, { detail: 1 });
    expect(click).not.toHaveBeenCalled();
    fireEvent.click(document.body, { detail: 0 });
    expect(click).toHaveBeenCalledOnce();
    pointer('pointerup', 1, 0);
    await vi.waitFor(() => {
      const later = createEvent.click(document.body, { detail: 1 });
      fireEvent(document.body, later);
      expect(later.defaultPrevented).toBe(false);
    });
    document.body.removeEventListener('click', click);
  });
});

it('a released mouse ends the drag of a library', () => {
  const up = vi.fn();
  window.addEventListener('mouseup', up);
  releaseMouse(document);
  expect(up).toHaveBeenCalledOnce();
  expect(up.mock.calls[0]![0]).toMatchObject({ button: 0, view: document.defaultView });
  window.removeEventListener('mouseup', up);
});
