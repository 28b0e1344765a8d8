import { Popover, UnstyledButton } from '@mantine/core';
import { IconChevronDown } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { useIsBack } from '@/store/moment/store';
import { useRunStore } from '@/store/run/store';
import { useShownState } from '../useShownState';
import { MessageRow } from './MessageRow';
import type { StripMessage } from './messages';
import { RunProgress } from './RunProgress';
import classes from './strip.module.css';
import { useMessages } from './useMessages';

/**
 * The strip for the messages of a run. Its height is fixed, so that a new message neither moves nor covers
 * anything. It shows the most important message, or the state of the executor in a sentence if there is none; nothing
 * while all is well: what runs is seen.
 * A tree that is held, at a block or in Python, has a banner of the same height in its place, unless there is a
 * message.
 */
export function RunStrip() {
  const { t } = useTranslation('run');
  const messages = useMessages();
  const isStarting = useRunStore((state) => state.stage !== null);
  const shown = useShownState();
  const [first] = messages;
  const isHeld = shown === 'held';
  const isBack = useIsBack();
  const isCutOff = first?.kind === 'connection' || first?.kind === 'silence';
  if (isHeld && !isBack && !first && !isStarting) return null;
  return (
    <section
      className={classes['strip']}
      aria-label={t('messages')}
      data-testid="run-strip"
      data-tone={first?.tone ?? 'calm'}
    >
      {isStarting && !isCutOff ? (
        <RunProgress />
      ) : first ? (
        <>
          <MessageRow message={first} />
          <AllMessages messages={messages} />
        </>
      ) : shown === 'application_running' ? null : (
        <p className={classes['calm']}>{t(`stateHelp.${shown}`)}</p>
      )}
    </section>
  );
}

/** The number of the other messages; a button opens all of them in full. */
function AllMessages({ messages }: { readonly messages: readonly StripMessage[] }) {
  const { t } = useTranslation('run');
  const [isOpen, setOpen] = useState(false);
  const others = messages.length - 1;
  return (
    <Popover opened={isOpen} onChange={setOpen} position="bottom-end" width="min(720px, 94vw)" trapFocus>
      <Popover.Target>
        <UnstyledButton
          className={classes['more']}
          aria-label={t('allMessages', { count: messages.length })}
          title={t('allMessages', { count: messages.length })}
          aria-expanded={isOpen}
          data-testid="all-messages"
          onClick={() => setOpen(!isOpen)}
        >
          {others > 0 ? `+${others}` : null}
          <IconChevronDown size={14} aria-hidden="true" />
        </UnstyledButton>
      </Popover.Target>
      <Popover.Dropdown p={0}>
        {messages.map((message) => (
          <MessageRow key={message.id} message={message} isWhole />
        ))}
      </Popover.Dropdown>
    </Popover>
  );
}
