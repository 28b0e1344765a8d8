import { highlightSelectionMatches } from '@codemirror/search';
import { EditorState, type Extension } from '@codemirror/state';
import { highlightActiveLineGutter, highlightSpecialChars, rectangularSelection } from '@codemirror/view';
import { pythonBreakpoints } from '@/features/python/gutter';
import { basics } from './basics';
import { languageOf } from './modes';
import { absenceKeys } from './language/absence';
import { languageSupport } from './language/client';
import { saveKeys } from './language/keys';

/** Returns all extensions of the editor of a file. */
export function extensionsFor(path: string, label: string): Extension {
  return [
    pythonBreakpoints(path), // first, so that its gutter is the leftmost
    basics(label, saveKeys(path)),
    highlightActiveLineGutter(),
    highlightSpecialChars(),
    EditorState.allowMultipleSelections.of(true),
    rectangularSelection(),
    highlightSelectionMatches(),
    languageOf(path),
    languageSupport(path),
    absenceKeys(path),
  ];
}
