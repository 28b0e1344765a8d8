import { Button, Group, Text } from '@mantine/core';
import { IconHourglass } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { isWorldPaused } from '@/store/session/clock';
import { useSessionStore } from '@/store/session/store';

interface PausedWorldProps {
  /** The effect of the pause on the panel that shows the notice. */
  readonly text: string;
}

/** A notice that the world's time is paused, with a button to resume it; nothing while time passes. */
export function PausedWorld({ text }: PausedWorldProps) {
  const { t } = useTranslation('run');
  const isPaused = useSessionStore(isWorldPaused);
  const command = useSessionStore(({ executor }) => (executor === 'paused' ? 'run.resume' : 'run.world'));
  const label = useCommandTable((table) => table.commands[command]?.labelKey);
  if (!isPaused) return null;
  return (
    <Group gap={8} wrap="nowrap" role="status" data-testid="paused-world">
      <IconHourglass size={15} aria-hidden="true" style={{ flex: 'none' }} />
      <Text size="xs" style={{ flex: 1 }}>
        <strong>{t('worldPaused')}</strong> {text}
      </Text>
      {label === undefined ? null : (
        <Button
          size="compact-xs"
          mih={24}
          variant="light"
          style={{ flex: 'none' }}
          onClick={() => perform(command)}
        >
          {t(label)}
        </Button>
      )}
    </Group>
  );
}
