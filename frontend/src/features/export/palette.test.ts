import { expect, it } from 'vitest';
import tokens from '@/ui/tokens.css?raw';
import { paletteOf } from './palette';

/** Returns the values of a token in the style sheet; that of the light theme is first. */
const valuesOf = (name: string) =>
  [...tokens.matchAll(new RegExp(`--bts-${name}: ([^;]+);`, 'g'))].map(([, value]) => value);

it.each(['surface', 'text', 'control', 'edge'])('has the %s of both themes', (name) => {
  expect([paletteOf('light')(name), paletteOf('dark')(name)]).toEqual(valuesOf(name));
  expect(paletteOf('light')(name)).not.toBe(paletteOf('dark')(name));
});

it("uses the light theme's value if the dark theme has none", () => {
  expect(paletteOf('dark')('radius')).toBe('8px');
});

it('has a colour for an unknown token', () => {
  expect(paletteOf('light')('nothing')).toBe('currentColor');
  expect(paletteOf('dark')('nothing')).toBe('currentColor');
});
