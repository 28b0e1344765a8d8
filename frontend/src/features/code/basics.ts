import {
  autocompletion,
  closeBrackets,
  closeBracketsKeymap,
  completionKeymap,
} from '@codemirror/autocomplete';
import { defaultKeymap, history, historyKeymap, indentWithTab } from '@codemirror/commands';
import { bracketMatching, foldGutter, foldKeymap, indentOnInput } from '@codemirror/language';
import { lintGutter, lintKeymap } from '@codemirror/lint';
import { search, searchKeymap } from '@codemirror/search';
import { EditorState, type Extension } from '@codemirror/state';
import {
  drawSelection,
  EditorView,
  highlightActiveLine,
  keymap,
  lineNumbers,
  type KeyBinding,
} from '@codemirror/view';
import { withoutFiles } from '@/model/copied';
import { useProjectStore } from '@/store/project';
import { editorTheme } from './editorTheme';
import { fontSizeKeys } from './fontSize';
import { escapeClosesHover } from './language/hoverEscape';
import { phrases } from './phrases';

/** Returns the extensions of every text editor, for files and for a tree's XML; `keys` take precedence. */
export function basics(label: string, keys: readonly KeyBinding[] = []): Extension {
  return [
    lineNumbers(),
    history(),
    foldGutter(),
    drawSelection(),
    EditorState.readOnly.of(useProjectStore.getState().role === 'viewer'),
    indentOnInput(),
    bracketMatching(),
    closeBrackets(),
    autocompletion(),
    highlightActiveLine(),
    search({ top: true }),
    lintGutter(),
    escapeClosesHover,
    editorTheme,
    phrases(),
    // Blocks that were copied from a canvas are pasted here as XML alone, without the files that they bring.
    EditorView.clipboardInputFilter.of(withoutFiles),
    // The element is focusable anyway; the attribute tells accessibility checks that its scroll area can be
    // reached by keyboard.
    EditorView.contentAttributes.of({ 'aria-label': label, tabindex: '0' }),
    keymap.of([
      ...keys,
      ...fontSizeKeys,
      ...closeBracketsKeymap,
      ...defaultKeymap,
      ...searchKeymap,
      ...historyKeymap,
      ...foldKeymap,
      ...completionKeymap,
      ...lintKeymap,
      // Escape, then Tab, leaves the editor by keyboard.
      indentWithTab,
    ]),
  ];
}
