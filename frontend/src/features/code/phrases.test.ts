import { EditorState } from '@codemirror/state';
import { expect, it, onTestFinished } from 'vitest';
import { setLanguage } from '@/i18n';
import { phrases } from './phrases';

it('says the words of the editor in the language of the page', () => {
  onTestFinished(() => {
    setLanguage('en');
    localStorage.clear();
  });
  const find = () => EditorState.create({ extensions: phrases() }).phrase('Find');
  expect(find()).toBe('Find');
  setLanguage('es');
  expect(find()).toBe('Buscar');
});
