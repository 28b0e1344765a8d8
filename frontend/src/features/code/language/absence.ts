import { Prec, type Extension } from '@codemirror/state';
import { keymap, type Command } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { useLanguageStore, type LanguageState } from '@/store/language';

const KEYS = ['F2', 'F12', 'Shift-F12'];

/** Returns the text of a page that waits for a place of a language server. */
export const waitingText = ({ before, isOwn }: Extract<LanguageState, { kind: 'waiting' }>): string =>
  isOwn ? t('code:language.waitingOwn') : t('code:language.waiting', { count: before });

/** Says why a key has no effect; leaves it to its own command while the language server runs. */
const explain: Command = () => {
  const { state } = useLanguageStore.getState();
  if (state.kind === 'ready') return false;
  const message =
    state.kind === 'failed'
      ? t('code:language.failed', { reason: state.reason || t('code:language.lost') })
      : state.kind === 'waiting'
        ? waitingText(state)
        : t(`code:language.${state.kind}`);
  notifications.show({ id: 'no-python-help', message });
  return true;
};

/** The keys of a Python editor that need the language server, for the time in which it does not run. */
export function absenceKeys(path: string): Extension {
  if (!path.endsWith('.py')) return [];
  return Prec.high(keymap.of(KEYS.map((key) => ({ key, run: explain, preventDefault: true }))));
}
