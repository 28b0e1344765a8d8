import { Button, CloseButton } from '@mantine/core';
import {
  IconAlertTriangle,
  IconEye,
  IconFlag,
  IconHourglass,
  IconPlugConnectedX,
  IconRotateClockwise,
  IconWorld,
} from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { openBlock } from '@/store/problems/open';
import { openFile } from '@/store/project/navigation';
import { dismiss } from './dismiss';
import type { MessageKind, MessageLink, StripMessage } from './messages';
import classes from './strip.module.css';

const ICONS: Record<MessageKind, typeof IconFlag> = {
  connection: IconPlugConnectedX,
  silence: IconHourglass,
  failure: IconAlertTriangle,
  fault: IconAlertTriangle,
  node: IconAlertTriangle,
  finished: IconFlag,
  viewer: IconEye,
  restart: IconRotateClockwise,
  world: IconWorld,
};
/** The test ids of some kinds of messages; all others have that of a banner. */
const TEST_IDS: Partial<Record<MessageKind, string>> = {
  viewer: 'looking-on',
  restart: 'restart-offer',
  world: 'world-runs',
};

interface MessageRowProps {
  readonly message: StripMessage;
  /** Whether the text has as many lines as it needs, as in the list of all messages. */
  readonly isWhole?: boolean;
}

/** The row of a message: its title, text and hint, and its next step. */
export function MessageRow({ message, isWhole = false }: MessageRowProps) {
  const { t, i18n } = useTranslation('run');
  const { kind, tone, titleKey, values, text, hint, link, first, command } = message;
  const title = i18n.exists(`run:${titleKey}`) ? t(titleKey, values) : t('banner.refused');
  const Icon = ICONS[kind];
  return (
    <div
      className={classes['message']}
      data-tone={tone}
      data-kind={kind}
      data-whole={isWhole || undefined}
      data-testid={isWhole ? 'strip-message' : (TEST_IDS[kind] ?? 'banner')}
      // The seconds change constantly, so screen readers get the silence from the executor's state instead.
      role={isWhole || kind === 'silence' ? undefined : tone === 'quiet' ? 'status' : 'alert'}
    >
      <Icon size={17} aria-hidden="true" />
      <div
        className={classes['text']}
        title={isWhole ? undefined : [title, text, hint].filter(Boolean).join(' ')}
      >
        <strong>{title}</strong>
        {text ? <span> {text}</span> : null}
        {hint ? <span className={classes['hint']}> {hint}</span> : null}
      </div>
      {link ? <GoButton link={link} /> : null}
      {first ? <CommandOffer id={first.command} label={first.labelKey} /> : null}
      {command ? (
        <CommandOffer id={command} label={message.commandKey} isSecond={first !== undefined} />
      ) : null}
      {message.canDismiss ? (
        <CloseButton size="sm" aria-label={t('dismiss')} onClick={() => dismiss(message)} />
      ) : null}
    </div>
  );
}

interface CommandOfferProps {
  readonly id: string;
  readonly label: string | undefined;
  readonly isSecond?: boolean;
}

function CommandOffer({ id, label, isSecond = false }: CommandOfferProps) {
  const { t } = useTranslation('run');
  const command = useCommandTable((table) => table.commands[id]);
  const key = label ?? command?.labelKey;
  return key === undefined ? null : (
    <Button
      className={classes['button'] ?? ''}
      size="compact-xs"
      variant={isSecond ? 'default' : 'filled'}
      onClick={() => perform(id)}
    >
      {t(key)}
    </Button>
  );
}

function GoButton({ link }: { readonly link: MessageLink }) {
  const { t } = useTranslation('run');
  const isThere = useProjectStore(({ files }) => !('file' in link) || link.file in files);
  if (!isThere) return null;
  const go = () => {
    if ('file' in link) return openFile(link.file, link.line);
    openBlock(link);
  };
  return (
    <Button className={classes['button'] ?? ''} size="compact-xs" variant="light" color="red" onClick={go}>
      {'file' in link
        ? t('openLine', { file: link.file.split('/').at(-1), line: link.line })
        : t('showBlock')}
    </Button>
  );
}
