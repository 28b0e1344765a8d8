import { ActionIcon, Badge, Button, Group, Menu, Text, TextInput } from '@mantine/core';
import { IconDots, IconDownload, IconLink, IconPinFilled } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { runs, type RunChange, type StoredRun } from '@/api/runs';
import { timeAgo } from '@/i18n/timeAgo';
import { linkTo } from '@/store/moment/address';
import { copyLink } from '@/ui/copying';
import { minutes } from './present';
import { ResultBadge } from './ResultBadge';
import { Thumbnail } from './Thumbnail';

const MEGA = 1e6;
const CLOSED_AFTER_MS = 200;

interface Props {
  readonly projectId: string;
  readonly run: StoredRun;
  readonly onOpen: () => void;
  readonly onChange: (change: RunChange) => Promise<boolean>;
  readonly onRemove: () => Promise<boolean>;
}

/** A kept run: its name, length, result, note, and its commands. */
export function RunRow({ projectId, run, onOpen, onChange, onRemove }: Props) {
  const { t, i18n } = useTranslation('runs');
  const [mode, setMode] = useState<'shown' | 'renamed' | 'removed' | 'shared'>('shown');
  const name = run.name || t('last');
  const back = () => setMode('shown');
  return (
    <li data-testid={`run-${run.id}`}>
      <Group gap="xs" wrap="nowrap" justify="space-between">
        <Thumbnail projectId={projectId} run={run} />
        <Group gap="xs" style={{ minWidth: 0, flex: 1 }}>
          {run.is_pinned ? <IconPinFilled size={14} role="img" aria-label={t('pinned')} /> : null}
          {mode === 'renamed' ? (
            <NameField name={name} onDone={(text) => (back(), text && void onChange({ name: text }))} />
          ) : (
            <Button
              variant="subtle"
              size="compact-sm"
              style={{ height: 'auto', whiteSpace: 'normal' }}
              title={t('open')}
              onClick={onOpen}
            >
              {name}
            </Button>
          )}
          <ResultBadge result={run.result} />
          {run.is_shared ? (
            <Badge size="sm" variant="outline" color="gray">
              {t('shared')}
            </Badge>
          ) : null}
          <Text size="xs" c="dimmed">
            {t('facts', {
              length: minutes(run.length_s),
              size: new Intl.NumberFormat(i18n.language, { maximumFractionDigits: 1 }).format(
                run.size / MEGA,
              ),
              when: timeAgo(run.created_at, i18n.language),
              keeper: run.keeper,
            })}
          </Text>
        </Group>
        {run.is_last && run.may_manage ? (
          <Button
            size="compact-sm"
            variant="default"
            title={t('keepLast')}
            onClick={() => void onChange({ is_last: false })}
          >
            {t('keep')}
          </Button>
        ) : null}
        <ActionIcon
          component="a"
          href={runs.recordingUrl(projectId, run.id)}
          download
          size="md"
          aria-label={t('download', { name })}
        >
          <IconDownload size={16} />
        </ActionIcon>
        <ActionIcon
          size="md"
          aria-label={t('link.copy', { name })}
          title={t('link.copy', { name })}
          onClick={() =>
            void copyLink(
              linkTo(projectId, { run: run.id, t: null }),
              t(run.is_shared ? 'link.shared' : 'link.private'),
            )
          }
        >
          <IconLink size={16} />
        </ActionIcon>
        {run.may_manage ? (
          <Menu position="bottom-end" width={240}>
            <Menu.Target>
              <ActionIcon size="md" aria-label={t('more', { name })}>
                <IconDots size={16} />
              </ActionIcon>
            </Menu.Target>
            <Menu.Dropdown>
              <Menu.Item onClick={() => setMode('renamed')}>{t('rename')}</Menu.Item>
              <Menu.Item onClick={() => void onChange({ is_pinned: !run.is_pinned })}>
                {t(run.is_pinned ? 'unpin' : 'pin')}
              </Menu.Item>
              {run.is_shared || run.may_share ? (
                <Menu.Item
                  onClick={() => (run.is_shared ? void onChange({ is_shared: false }) : setMode('shared'))}
                >
                  {t(run.is_shared ? 'unshare' : 'share')}
                </Menu.Item>
              ) : null}
              <Menu.Divider />
              <Menu.Item color="red" onClick={() => setMode('removed')}>
                {t('remove')}
              </Menu.Item>
            </Menu.Dropdown>
          </Menu>
        ) : null}
      </Group>
      {run.note ? (
        <Text size="sm" c="dimmed" style={{ overflowWrap: 'anywhere' }}>
          {run.note}
        </Text>
      ) : null}
      {mode === 'removed' || mode === 'shared' ? (
        <Group gap="xs" mt={4} role="alert">
          <Text size="sm" style={{ flex: 1 }}>
            {t(mode === 'removed' ? 'removeSure' : 'shareSure')}
          </Text>
          <Button size="compact-sm" variant="default" onClick={back}>
            {t('cancel')}
          </Button>
          <Button
            size="compact-sm"
            {...(mode === 'removed' ? { color: 'red' } : {})}
            onClick={() => {
              back();
              void (mode === 'removed' ? onRemove() : onChange({ is_shared: true }));
            }}
          >
            {t(mode === 'removed' ? 'remove' : 'shareNow')}
          </Button>
        </Group>
      ) : null}
    </li>
  );
}

/** A field for a new name; Enter takes it, Escape and an empty name do not. */
function NameField({ name, onDone }: { readonly name: string; readonly onDone: (name: string) => void }) {
  const { t } = useTranslation('runs');
  const [text, setText] = useState(name);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    // The menu that was used gives up the focus only when it has closed.
    const timer = setTimeout(() => field.current?.select(), CLOSED_AFTER_MS);
    return () => clearTimeout(timer);
  }, []);
  return (
    <TextInput
      size="xs"
      aria-label={t('name')}
      maxLength={100}
      value={text}
      ref={field}
      // Escape leaves the field, not the dialogue around it, which listens at the window.
      data-mantine-stop-propagation="true"
      onChange={(event) => setText(event.currentTarget.value)}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key === 'Enter') onDone(text.trim());
        if (event.key === 'Escape') onDone('');
      }}
    />
  );
}
