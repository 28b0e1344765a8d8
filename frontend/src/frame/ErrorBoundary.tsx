import { Button, Center, Code, Stack, Text, Title } from '@mantine/core';
import { Component, type ReactNode } from 'react';
import { t } from '@/i18n';
import { PartMissing } from '@/ui/parts';

interface Props {
  readonly children: ReactNode;
}

interface State {
  readonly error: Error | null;
}

/**
 * The message for an internal error, or for a part that did not load. It says that edits are kept, and offers
 * to continue.
 */
export class ErrorBoundary extends Component<Props, State> {
  override state: State = { error: null };

  static getDerivedStateFromError(error: Error): State {
    return { error };
  }

  override render() {
    const { error } = this.state;
    if (!error) return this.props.children;
    const what = error instanceof PartMissing ? 'missing' : 'crash';
    return (
      <Center h="100%" p="xl" role="alert">
        <Stack maw={560} gap="md">
          <Title order={3}>{t(`frame:${what}.title`)}</Title>
          <Text c="dimmed">{t(`frame:${what}.text`)}</Text>
          <Code block>{error.message}</Code>
          <Button w="fit-content" onClick={() => window.location.reload()}>
            {t('frame:crash.reload')}
          </Button>
        </Stack>
      </Center>
    );
  }
}
