import { ActionIcon, Tooltip, type ActionIconProps } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { usePressed } from './hooks/usePressed';

interface CommandButtonProps extends Pick<ActionIconProps, 'color' | 'variant' | 'size'> {
  readonly command: string;
  readonly isDisabled?: boolean;
  readonly testId?: string;
}

/** A button for a user command, with its icon and tooltip. */
export function CommandButton({ command: id, isDisabled = false, testId, ...look }: CommandButtonProps) {
  const { t } = useTranslation();
  const command = useCommandTable((table) => table.commands[id]);
  const { isPressed, handlers } = usePressed();
  if (!command) return null;
  const label = t(command.labelKey);
  const keys = keysOf(command);
  const Icon = command.icon;
  return (
    <Tooltip label={keys ? `${label} (${keys})` : label} disabled={isPressed}>
      <ActionIcon
        size="lg"
        aria-label={label}
        disabled={isDisabled}
        onClick={() => perform(id)}
        {...handlers}
        {...look}
        {...(testId ? { 'data-testid': testId } : {})}
      >
        {Icon ? <Icon size={19} /> : null}
      </ActionIcon>
    </Tooltip>
  );
}
