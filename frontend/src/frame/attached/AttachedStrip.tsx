import { Button } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { MessageRow } from '@/features/run/strip/MessageRow';
import { useMessages } from '@/features/run/strip/useMessages';
import strip from '@/features/run/strip/strip.module.css';
import { useIsBack } from '@/store/moment/store';
import { useSessionStore } from '@/store/session/store';
import { attachAgain } from './commands';

/** The messages of a run that concern a followed program as well: those of the page and its commands. */
const OURS: readonly string[] = ['connection', 'silence', 'failure', 'viewer'];

/** The strip of a page that follows a program: what it does, or why it cannot. */
export function AttachedStrip({ address }: { readonly address: string }) {
  const { t } = useTranslation('attached');
  const attached = useSessionStore((state) => state.attached);
  const executor = useSessionStore((state) => state.executor);
  const fault = useSessionStore((state) => state.faults.at(-1)?.message);
  const isHeld = executor === 'held';
  const isBack = useIsBack();
  const [first] = useMessages().filter(({ kind }) => OURS.includes(kind));
  if (isHeld && !isBack && !first) return null;
  const isGone = executor === 'visualization_ready';
  const isSilent = attached?.state === 'silent';
  const problem = (isGone ? (fault ?? attached?.problem) : attached?.problem) ?? '';
  const text = isGone ? 'gone' : isSilent ? 'silent' : attached?.controls ? 'controlling' : 'looking';
  return (
    <section
      className={strip['strip']}
      aria-label={t('badge')}
      data-testid="attached-strip"
      data-tone={first?.tone ?? (isGone ? 'error' : isSilent ? 'warning' : 'calm')}
    >
      {first ? (
        <MessageRow message={first} />
      ) : (
        <>
          <p
            className={strip['calm']}
            role="status"
            title={t(text, { address, problem, noStop: t('noStop') })}
          >
            {t(text, { address, problem, noStop: t('noStop') })}
          </p>
          {isGone ? (
            <Button size="compact-xs" data-testid="attached-again" onClick={() => void attachAgain()}>
              {t('again')}
            </Button>
          ) : null}
        </>
      )}
    </section>
  );
}
