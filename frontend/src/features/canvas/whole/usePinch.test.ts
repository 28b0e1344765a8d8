import { fireEvent, renderHook } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { usePinch } from './usePinch';

it('hears zooming in with Ctrl or Meta, keeps the page from being zoomed, and ends with its owner', () => {
  const element = document.createElement('div');
  const onZoomIn = vi.fn();
  const { unmount } = renderHook(() => usePinch({ current: element }, onZoomIn));
  expect(fireEvent.wheel(element, { deltaY: -5 })).toBe(true);
  expect(fireEvent.wheel(element, { deltaY: 5, ctrlKey: true })).toBe(false);
  expect(onZoomIn).not.toHaveBeenCalled();
  fireEvent.wheel(element, { deltaY: -5, ctrlKey: true });
  fireEvent.wheel(element, { deltaY: -5, metaKey: true });
  expect(onZoomIn).toHaveBeenCalledTimes(2);
  unmount();
  fireEvent.wheel(element, { deltaY: -5, ctrlKey: true });
  expect(onZoomIn).toHaveBeenCalledTimes(2);
});
