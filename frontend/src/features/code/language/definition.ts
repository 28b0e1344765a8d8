import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';

/** Shows a definition that was gone to in the middle of the editor: a line at its edge is read without its context. */
export const definitionInTheMiddle = EditorState.transactionExtender.of((transaction) =>
  transaction.isUserEvent('select.definition')
    ? { effects: EditorView.scrollIntoView(transaction.newSelection.main.head, { y: 'center' }) }
    : null,
);
