import { expect, it } from 'vitest';
import tokens from '@/ui/tokens.css?raw';
import { paletteOf } from './palette';

/** Returns the values of a token in the style sheet; that of the light theme is first. */
const valuesOf = (name: string) =>
  [...tokens.matchAll(new RegExp(`--bts-${name}: ([^;]+);`, 'g'))].map(([, value]) => value);

it.each(['surface', 'text', 'control', 'edge'])('knows the %s of both themes', (name) => {
  expect([paletteOf('light')(name), paletteOf('dark')(name)]).toEqual(valuesOf(name));
  expect(paletteOf('light')(name)).not.toBe(paletteOf('dark')(name));
});

it('takes what the dark theme leaves as it is from the light one', () => {
  expect(paletteOf('dark')('radius')).toBe('8px');
});

it('has a colour for a token that there is not', () => {
  expect(paletteOf('light')('nothing')).toBe('currentColor');
  expect(paletteOf('dark')('nothing')).toBe('currentColor');
});
