import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { expect, it } from 'vitest';
import { definitionInTheMiddle } from './definition';

it('scrolls to the middle where a definition was gone to, and nowhere else', () => {
  const state = EditorState.create({ doc: 'one\ntwo\nthree', extensions: definitionInTheMiddle });
  const go = (userEvent: string) => state.update({ selection: { anchor: 4 }, userEvent }).effects;
  const wanted = EditorView.scrollIntoView(4, { y: 'center' });
  expect(go('select.definition').map(({ value }) => value as unknown)).toEqual([wanted.value]);
  expect(go('select.pointer')).toEqual([]);
});
