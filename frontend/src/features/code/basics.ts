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
import { useProjectStore } from '@/store/project';
import { editorTheme } from './editorTheme';
import { fontSizeKeys } from './fontSize';
import { phrases } from './phrases';

/** What every editor of a project's text has: of files, and of a tree's XML; `keys` come before its own. */
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
    editorTheme,
    phrases(),
    // What is edited takes the focus anyhow; that it is said lets what scrolls be known as reachable by keyboard.
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
