import { Button, Group, Text } from '@mantine/core';
import { notifications } from '@mantine/notifications';

interface UndoNotification {
  message: string;
  undoLabel: string;
  undo: () => void;
}

/** Shows a notification with a button that undoes the reported change. */
export function undoNotification({ message, undoLabel, undo }: UndoNotification): void {
  const id = notifications.show({
    autoClose: 10_000,
    message: (
      <Group justify="space-between" wrap="nowrap">
        <Text size="sm">{message}</Text>
        <Button
          size="compact-sm"
          style={{ flex: 'none' }}
          variant="light"
          onClick={() => {
            notifications.hide(id);
            undo();
          }}
        >
          {undoLabel}
        </Button>
      </Group>
    ),
  });
}
