import { Center, Loader, Stack, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';

interface WaitingProps {
  /** The reason for waiting: a key in `frame:waiting`. */
  readonly reason: 'openingProject' | 'loadingViewer' | 'loadingEditor';
}

/** A spinner with the reason for waiting. */
export function Waiting({ reason }: WaitingProps) {
  const { t } = useTranslation('frame');
  return (
    <Center h="100%" mih={120} role="status">
      <Stack align="center" gap="xs">
        <Loader size="sm" />
        <Text size="sm" c="dimmed">
          {t(`waiting.${reason}`)}
        </Text>
      </Stack>
    </Center>
  );
}
