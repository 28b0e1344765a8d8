import { ActionIcon, Tooltip } from '@mantine/core';
import { IconActivity } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { showValues, useShownValues, type ShownPort } from '@/store/session/values/shown';

interface ShowValueProps {
  readonly port: ShownPort;
  readonly name: string;
}

/** A button that shows or hides the live value of a port in the block. */
export function ShowValue({ port, name }: ShowValueProps) {
  const { t } = useTranslation('inspector');
  const isShown = useShownValues(({ ports }) => ports.has(port));
  return (
    <Tooltip label={t('showValueHint')}>
      <ActionIcon
        size={24}
        variant={isShown ? 'light' : 'subtle'}
        aria-label={t('showValue', { name })}
        aria-pressed={isShown}
        onClick={() => showValues([port], !isShown)}
      >
        <IconActivity size={14} aria-hidden="true" />
      </ActionIcon>
    </Tooltip>
  );
}
