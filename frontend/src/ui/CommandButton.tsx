import { ActionIcon, Tooltip, type ActionIconProps } from '@mantine/core';
import { perform, useCommandTable } from '@/commands/registry';
import { keysOf } from '@/commands/shortcuts';
import { usePlainWords } from './hooks/usePlainWords';
import { usePressed } from './hooks/usePressed';

interface CommandButtonProps extends Pick<ActionIconProps, 'color' | 'variant' | 'size'> {
  readonly command: string;
  /** What the command means here, in place of its label. */
  readonly label?: string;
  readonly isDisabled?: boolean;
  /** Why the command is not possible now; the button stays focusable, so that its tooltip can say it. */
  readonly reason?: string | null;
  readonly testId?: string;
}

/** A button for a user command, with its icon and tooltip. */
export function CommandButton({
  command: id,
  label: given,
  isDisabled = false,
  reason = null,
  testId,
  ...look
}: CommandButtonProps) {
  const t = usePlainWords('frame');
  const command = useCommandTable((table) => table.commands[id]);
  const { isPressed, handlers } = usePressed();
  if (!command) return null;
  const label = given ?? t(command.labelKey);
  const keys = keysOf(command);
  const Icon = command.icon;
  return (
    <Tooltip
      label={reason ?? (keys ? `${label} (${keys})` : label)}
      disabled={isPressed && reason === null}
      events={{ hover: true, focus: reason !== null, touch: reason !== null }}
      {...(reason === null ? {} : { multiline: true, maw: 340 })}
    >
      <ActionIcon
        size="lg"
        aria-label={label}
        disabled={isDisabled}
        {...(reason === null ? {} : { 'data-disabled': true, 'aria-disabled': true })}
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
