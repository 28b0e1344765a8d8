import type { KeyBinding } from '@codemirror/view';

const KEY = 'bts.codeSize';
const DEFAULT = 13;

function apply(size: number): boolean {
  const kept = Math.min(28, Math.max(9, size));
  localStorage.setItem(KEY, String(kept));
  document.documentElement.style.setProperty('--bts-code-size', `${kept}px`);
  return true;
}

const current = () => Number(localStorage.getItem(KEY) ?? DEFAULT);

export const applyKeptFontSize = () => apply(current());

export const fontSizeKeys: KeyBinding[] = [
  { key: 'Mod-=', run: () => apply(current() + 1), preventDefault: true },
  { key: 'Mod-+', run: () => apply(current() + 1), preventDefault: true },
  { key: 'Mod--', run: () => apply(current() - 1), preventDefault: true },
  { key: 'Mod-0', run: () => apply(DEFAULT), preventDefault: true },
];
