import { EditorState, type Extension } from '@codemirror/state';
import { t } from '@/i18n';

/** The words of the editor's own panels, by what they are in English, in the language of the page. */
export const phrases = (): Extension =>
  EditorState.phrases.of(t('code:phrases', { returnObjects: true }) as Record<string, string>);
