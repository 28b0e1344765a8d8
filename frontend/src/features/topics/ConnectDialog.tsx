import { Alert, Button, Code, CopyButton, Divider, Group, Modal, Stack, Text } from '@mantine/core';
import { IconCheck, IconCopy } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { create } from 'zustand';
import { useProjectStore } from '@/store/project';
import { hasApplication } from '@/store/run/commands';
import { runProject } from '@/store/run/run';
import { useSessionStore } from '@/store/session/store';
import { exportLines } from './environment';
import { Groot2Switch } from './Groot2Switch';

const useConnecting = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openConnect = () => useConnecting.setState({ isOpen: true });
const close = () => useConnecting.setState({ isOpen: false });

/** Says why tools see nothing of exact runs, with a button that makes runs live. */
function ExactAlert() {
  const { t } = useTranslation('topics');
  const runs = useSessionStore(hasApplication);
  const goLive = () => {
    useProjectStore.getState().setSettings({ time: 'live' });
    if (runs) void runProject();
  };
  return (
    <Alert color="yellow">
      <Group justify="space-between" gap="xs">
        <Text size="sm">{t('connectExact')}</Text>
        <Button size="xs" variant="light" color="yellow" data-testid="connect-live" onClick={goLive}>
          {t(runs ? 'connectRunLive' : 'connectLive')}
        </Button>
      </Group>
    </Alert>
  );
}

/** A dialogue with the environment variables for a terminal in which RViz and `ros2` see this session. */
export function ConnectDialog() {
  const { t } = useTranslation('topics');
  const isOpen = useConnecting((state) => state.isOpen);
  const environment = useSessionStore((state) => state.introspection?.ros_environment);
  const isExact = useProjectStore((state) => state.settings?.time === 'exact');
  const lines = environment ? exportLines(environment) : '';
  return (
    <Modal opened={isOpen} onClose={close} title={t('connectTitle')} size="lg">
      <Stack gap="sm" data-testid="connect-ros">
        {lines ? (
          <>
            {isExact && <ExactAlert />}
            <Text size="sm">{t('connectText')}</Text>
            <Code block data-testid="ros-environment">
              {lines}
            </Code>
            <Group justify="space-between">
              <Text size="xs" c="dimmed">
                {t('connectThen')} <Code>ros2 topic list</Code> <Code>rviz2</Code>
              </Text>
              <CopyButton value={lines}>
                {({ copied, copy }) => (
                  <Button
                    data-autofocus
                    leftSection={copied ? <IconCheck size={15} /> : <IconCopy size={15} />}
                    color={copied ? 'teal' : 'indigo'}
                    onClick={copy}
                  >
                    {t(copied ? 'copied' : 'copy')}
                  </Button>
                )}
              </CopyButton>
            </Group>
            <Divider />
            <Groot2Switch />
          </>
        ) : (
          <Alert color="gray">{t(environment ? 'connectClosed' : 'connectOff')}</Alert>
        )}
      </Stack>
    </Modal>
  );
}
