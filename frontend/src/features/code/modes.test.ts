import { indentUnit, language } from '@codemirror/language';
import { EditorState } from '@codemirror/state';
import { expect, it } from 'vitest';
import { isXml, languageOf } from './modes';

it.each([
  ['a.py', 'python', 4],
  ['a.json', 'json', 2],
  ['a.xml', 'xml', 2],
  ['a.urdf', 'xml', 2],
  ['a.sdf', 'xml', 2],
  ['a.launch', 'xml', 2],
  ['a.yaml', 'yaml', 2],
  ['a.yml', 'yaml', 2],
  ['a.md', 'markdown', 2],
  ['a.markdown', 'markdown', 2],
  ['a.txt', undefined, 2],
  ['a.python', undefined, 2],
])('%s is %s, indented by %s', (path, name, indent) => {
  const state = EditorState.create({ extensions: languageOf(path) });
  expect(state.facet(language)?.name).toBe(name);
  expect(state.facet(indentUnit)).toBe(' '.repeat(indent));
});

it('recognises XML files by their names', () => {
  expect(['a.xml', 'b/a.urdf', 'a.xml.txt', 'xml'].map(isXml)).toEqual([true, true, false, false]);
});
