import { highlightSelectionMatches } from '@codemirror/search';
import { EditorState, type Extension } from '@codemirror/state';
import { highlightActiveLineGutter, highlightSpecialChars, rectangularSelection } from '@codemirror/view';
import { basics } from './basics';
import { languageOf } from './modes';
import { languageSupport } from './language/client';
import { saveKeys } from './language/keys';

/** Everything that an editor of this file is made of. */
export function extensionsFor(path: string, label: string): Extension {
  return [
    basics(label, saveKeys(path)),
    highlightActiveLineGutter(),
    highlightSpecialChars(),
    EditorState.allowMultipleSelections.of(true),
    rectangularSelection(),
    highlightSelectionMatches(),
    languageOf(path),
    languageSupport(path),
  ];
}
