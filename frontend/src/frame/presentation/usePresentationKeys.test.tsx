import { renderHook } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { usePresentation } from '@/workspace/presentation';
import { usePresentationKeys } from './usePresentationKeys';

const isOn = () => usePresentation.getState().mode === 'tree';

function press(target: Element = document.body): KeyboardEvent {
  const event = new KeyboardEvent('keydown', { key: 'Escape', bubbles: true, cancelable: true });
  target.dispatchEvent(event);
  return event;
}

function within(html: string): Element {
  document.body.innerHTML = html;
  return document.querySelector('[data-here]')!;
}

beforeEach(() => {
  usePresentation.setState({ mode: 'tree', isFull: false });
  renderHook(() => usePresentationKeys(true));
  onTestFinished(() => {
    document.body.innerHTML = '';
    usePresentation.setState(usePresentation.getInitialState(), true);
  });
});

describe('Escape', () => {
  it('ends the presentation, before the canvas hears of it', () => {
    const canvas = within('<div data-here></div>');
    const heard = vi.fn();
    canvas.addEventListener('keydown', heard);
    expect(press(canvas).defaultPrevented).toBe(true);
    expect(isOn()).toBe(false);
    expect(heard).not.toHaveBeenCalled();
  });

  it.each([
    ['<input data-here>'],
    ['<div role="dialog"><button data-here></button></div>'],
    ['<div role="menu"></div><div data-here></div>'],
    ['<div aria-modal="true"></div><div data-here></div>'],
  ])('belongs to what is open: %s', (html) => {
    expect(press(within(html)).defaultPrevented).toBe(false);
    expect(isOn()).toBe(true);
  });

  it('belongs to a drag', () => {
    window.dispatchEvent(new Event('pointerdown'));
    press();
    expect(isOn()).toBe(true);
    window.dispatchEvent(new Event('pointerup'));
    press();
    expect(isOn()).toBe(false);
  });
});

it('ends with its own full screen', () => {
  document.dispatchEvent(new Event('fullscreenchange'));
  expect(isOn()).toBe(true);
  usePresentation.setState({ isFull: true });
  document.dispatchEvent(new Event('fullscreenchange'));
  expect(isOn()).toBe(false);
});
