import type { EditorView } from '@codemirror/view';
import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { applyKeptFontSize, fontSizeKeys } from './fontSize';

const size = () => document.documentElement.style.getPropertyValue('--bts-code-size');
const press = (key: string) =>
  fontSizeKeys.find((binding) => binding.key === key)?.run?.(undefined as unknown as EditorView);

beforeEach(() => {
  localStorage.clear();
  onTestFinished(() => localStorage.clear());
});

it('is 13 px at first, then the last value', () => {
  applyKeptFontSize();
  expect(size()).toBe('13px');
  localStorage.setItem('bts.codeSize', '20');
  applyKeptFontSize();
  expect(size()).toBe('20px');
});

it.each([
  ['Mod-=', '14px'],
  ['Mod-+', '14px'],
  ['Mod--', '12px'],
])('%s changes it by one', (key, expected) => {
  expect(press(key)).toBe(true);
  expect(size()).toBe(expected);
  expect(localStorage.getItem('bts.codeSize')).toBe(expected.replace('px', ''));
});

it('is reset by Mod-0', () => {
  localStorage.setItem('bts.codeSize', '20');
  press('Mod-0');
  expect(size()).toBe('13px');
});

it('stays readable, and fits the window', () => {
  localStorage.setItem('bts.codeSize', '28');
  press('Mod-=');
  expect(size()).toBe('28px');
  localStorage.setItem('bts.codeSize', '9');
  press('Mod--');
  expect(size()).toBe('9px');
});

it("prevents the browser's action for its keys", () => {
  expect(fontSizeKeys.every(({ preventDefault }) => preventDefault)).toBe(true);
});
