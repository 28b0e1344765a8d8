import { describe, expect, it } from 'vitest';
import { sentEvent } from './sentEvents';

function element(): HTMLElement {
  const made = document.createElement('div');
  made.getBoundingClientRect = () => new DOMRect(100, 50, 400, 300);
  return made;
}

describe('an event for the worker', () => {
  it('has its place relative to the canvas', () => {
    const event = new MouseEvent('pointermove', { clientX: 130, clientY: 70, buttons: 1, shiftKey: true });
    expect(sentEvent(event, element())).toMatchObject({
      ...{ type: 'pointermove', clientX: 30, clientY: 20, pageX: 30, pageY: 20 },
      ...{ buttons: 1, shiftKey: true },
    });
  });

  it('has the way of a wheel, and the name of a key', () => {
    expect(sentEvent(new WheelEvent('wheel', { deltaY: -3 }), element())).toMatchObject({ deltaY: -3 });
    const key = sentEvent(new KeyboardEvent('keydown', { key: 'q' }), element());
    expect(key).toMatchObject({ type: 'keydown', key: 'q' });
    expect(key).not.toHaveProperty('clientX');
  });

  it('can be copied to another thread', () => {
    const sent = sentEvent(new MouseEvent('pointerdown'), element());
    expect(structuredClone(sent)).toEqual(sent);
  });
});
