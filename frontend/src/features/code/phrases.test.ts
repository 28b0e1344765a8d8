import { EditorState } from '@codemirror/state';
import { expect, it, onTestFinished } from 'vitest';
import { setLanguage } from '@/i18n';
import { phrases } from './phrases';

it("translates the editor's texts", () => {
  onTestFinished(() => {
    setLanguage('en');
    localStorage.clear();
  });
  const find = () => EditorState.create({ extensions: phrases() }).phrase('Find');
  expect(find()).toBe('Find');
  setLanguage('es');
  expect(find()).toBe('Buscar');
});
