import { ActionIcon, Tooltip, type ActionIconProps } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { perform, useActionTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';

interface ActionButtonProps extends Pick<ActionIconProps, 'color' | 'variant' | 'size'> {
  readonly action: string;
  readonly isDisabled?: boolean;
  readonly testId?: string;
}

/** A button of the table of user actions: its icon, its text and shortcut as tooltip. */
export function ActionButton({ action: id, isDisabled = false, testId, ...look }: ActionButtonProps) {
  const { t } = useTranslation();
  const action = useActionTable((table) => table.actions[id]);
  if (!action) return null;
  const label = t(action.labelKey);
  const keys = keysOf(action);
  const Icon = action.icon;
  return (
    <Tooltip label={keys ? `${label} (${keys})` : label}>
      <ActionIcon
        size="lg"
        aria-label={label}
        disabled={isDisabled}
        onClick={() => perform(id)}
        {...look}
        {...(testId ? { 'data-testid': testId } : {})}
      >
        {Icon ? <Icon size={19} /> : null}
      </ActionIcon>
    </Tooltip>
  );
}
