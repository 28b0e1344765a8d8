import { act, renderHook } from '@testing-library/react';
import { expect, it } from 'vitest';
import { setLanguage } from '@/i18n';
import type { PlacesInFile } from '../language/places';
import { usePlacesText } from './usePlacesText';

const places = (count: number): PlacesInFile => ({
  uri: '',
  name: '',
  isOutside: false,
  places: Array.from({ length: count }, (_, line) => ({ uri: '', line, from: 0, to: 1, text: 'x' })),
});

it('counts places and files, in both languages', async () => {
  const { result } = renderHook(usePlacesText);
  expect(result.current([places(1)])).toBe('1 place in 1 file');
  expect(result.current([places(1), places(2)])).toBe('3 places in 2 files');
  await act(() => setLanguage('es'));
  expect(result.current([places(1)])).toBe('1 lugar en 1 archivo');
  expect(result.current([places(1), places(2)])).toBe('3 lugares en 2 archivos');
  await act(() => setLanguage('en'));
});
