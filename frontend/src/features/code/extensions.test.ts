import { language } from '@codemirror/language';
import { EditorState } from '@codemirror/state';
import { expect, it } from 'vitest';
import { openProject } from '../../../harness/testing';
import { extensionsFor } from './extensions';

it('makes an editor for the language of its file, with several cursors', () => {
  openProject({});
  const state = EditorState.create({ doc: '{}', extensions: extensionsFor('a.json', 'Source') });
  expect(state.facet(language)?.name).toBe('json');
  expect(state.facet(EditorState.allowMultipleSelections)).toBe(true);
});
