import { renderHook } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useSavingStore } from './store';
import { useUnsaved } from './useUnsaved';

const unsaved = () => useSavingStore.getState().unsaved;

it('counts each text that is shown, until it is in the project or its field is gone', () => {
  const fields = [true, false].map((isShown) =>
    renderHook((is: boolean) => useUnsaved(is), { initialProps: isShown }),
  );
  expect(unsaved()).toBe(1);
  fields[1]?.rerender(true);
  expect(unsaved()).toBe(2);
  fields[1]?.rerender(false);
  expect(unsaved()).toBe(1);
  fields[0]?.unmount();
  expect(unsaved()).toBe(0);
});
