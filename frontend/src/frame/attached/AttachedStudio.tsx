import '@/i18n/editorTexts';
import { Button, Center, Group, Loader, Stack, Text, Title } from '@mantine/core';
import { useMediaQuery } from '@mantine/hooks';
import { useMutation } from '@tanstack/react-query';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { api } from '@/api/client';
import { reasonOf } from '@/api/reason';
import { closePalette } from '@/commands/palette';
import { useShortcuts } from '@/commands/shortcuts';
import { useMe } from '@/features/accounts/useMe';
import { registerAxisCommands } from '@/features/axis/commands';
import { TimeAxis } from '@/features/axis/TimeAxis';
import { registerCanvasCommands } from '@/features/canvas/commands/canvasCommands';
import { registerDebugCommands } from '@/features/debug/commands';
import { HeldBanner } from '@/features/debug/HeldBanner';
import { followProject } from '@/store/debug/breakpoints';
import { followMarks } from '@/store/debug/marks';
import { followBreakpoints } from '@/store/debug/sync';
import { followPresent } from '@/store/moment/looking';
import { useIsBack } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { setNavigator } from '@/store/project/navigation';
import { navigate } from '@/store/route';
import { openBegun } from '@/store/route/begun';
import { useSessionStore } from '@/store/session/store';
import { CommandPalette } from '@/workspace/CommandPalette';
import { attachedLayout } from '@/workspace/layoutModel';
import { aimAt, closeGone, followFront, openTab, showTree, reopen, useTabs } from '@/workspace/tabs';
import { Dock } from '../Dock';
import { followPast } from '../followPast';
import classes from '../frame.module.css';
import { AttachedBar } from './AttachedBar';
import { AttachedStatus } from './AttachedStatus';
import { AttachedStrip } from './AttachedStrip';
import { attachAgain, attachedTitle, registerAttachedCommands } from './commands';
import { attachedId } from './detail';
import { useAttached } from './useAttached';

interface AttachedProps {
  readonly sessionId: string;
}

/** The page of a session that follows the tree of another program. */
export function AttachedStudio({ sessionId }: AttachedProps) {
  const { address, isShown, error, hasEnded } = useAttached(sessionId);
  useEffect(() => {
    document.title = `${attachedTitle(address)} — BT Studio`;
  }, [address]);
  if (hasEnded) return <Ended address={address} why={error?.message ?? ''} />;
  if (!isShown) return <Connecting address={address} error={error} />;
  return <AttachedWorkbench address={address} />;
}

/** The page while the tree is not known: it waits, or says why there is none. */
function Connecting({ address, error }: { readonly address: string; readonly error: Error | null }) {
  const { t } = useTranslation('attached');
  const fault = useSessionStore((state) => state.faults.at(-1));
  if (!error && !fault) {
    return (
      <Center h="100%" role="status">
        <Group gap="sm">
          <Loader size="sm" />
          <Text>{t('connecting', { address })}</Text>
        </Group>
      </Center>
    );
  }
  return (
    <Problem
      title={t('cannot', { address })}
      text={error ? reasonOf(error) : (fault?.message ?? '')}
      hint={fault?.hint ?? ''}
    >
      {error ? null : (
        <Button data-testid="attached-again" onClick={() => void attachAgain()}>
          {t('again')}
        </Button>
      )}
    </Problem>
  );
}

/** The page of a session that is over: the program can be followed in another one. */
function Ended({ address, why }: { readonly address: string; readonly why: string }) {
  const { t } = useTranslation('attached');
  const { mutate, isPending, error } = useMutation({
    mutationFn: api.attach,
    onSuccess: openBegun,
  });
  return (
    <Problem title={t('ended')} text={error ? reasonOf(error) : why} hint="">
      <Button loading={isPending} data-testid="attached-again" onClick={() => mutate(address)}>
        {t('again')}
      </Button>
    </Problem>
  );
}

interface ProblemProps {
  readonly title: string;
  readonly text: string;
  readonly hint: string;
  readonly children: React.ReactNode;
}

function Problem({ title, text, hint, children }: ProblemProps) {
  const { t } = useTranslation('attached');
  return (
    <Center h="100%" role="alert" p="md">
      <Stack maw={520} gap="sm" data-testid="attached-problem">
        <Title order={1} size="h3">
          {title}
        </Title>
        <Text>{text}</Text>
        {hint ? <Text c="dimmed">{hint}</Text> : null}
        <Group gap="sm">
          {children}
          <Button variant="default" onClick={() => navigate('/')}>
            {t('back')}
          </Button>
        </Group>
      </Stack>
    </Center>
  );
}

function AttachedWorkbench({ address }: { readonly address: string }) {
  const isNarrow = useMediaQuery('(max-width: 900px)', false, { getInitialValueInEffect: false });
  const width = isNarrow ? 'narrow' : 'wide';
  const model = useTabs((state) => state.model);
  const modelWidth = useTabs((state) => state.width);
  const isBack = useIsBack();
  useShortcuts();

  const user = useMe()?.user;
  useEffect(() => (user === undefined ? undefined : followProject(user)), [user]);

  useEffect(() => {
    const unregister = [
      registerCanvasCommands(),
      registerDebugCommands(),
      registerAxisCommands(),
      registerAttachedCommands(),
      followBreakpoints(),
      followMarks(),
      followPresent(),
      followPast(),
    ];
    setNavigator({
      openTree: (id) => openTab({ kind: 'tree', id }),
      showTree,
      openFile: () => undefined,
      showFile: () => undefined,
      openTopics: () => undefined,
      focusField: () => undefined,
      renamed: () => undefined,
      aimAt,
    });
    const unwatch = useProjectStore.subscribe(({ diagrams, mainTree }, before) => {
      if (diagrams === before.diagrams) return;
      closeGone();
      if (mainTree in diagrams) openTab({ kind: 'tree', id: mainTree });
    });
    return () => {
      unwatch();
      closePalette();
      unregister.forEach((undo) => undo?.());
      useTabs.setState({ model: null, target: null });
    };
  }, []);

  useEffect(() => {
    if (model && modelWidth === width) return;
    const fresh = attachedLayout(width);
    useTabs.setState({ model: fresh, width });
    reopen(attachedId(address), useProjectStore.getState().mainTree);
    followFront(fresh);
  }, [model, modelWidth, width, address]);

  return (
    <div className={classes['studio']} data-past={isBack || undefined}>
      <AttachedBar />
      <AttachedStrip address={address} />
      <HeldBanner />
      <main className={classes['dock']}>
        {model && modelWidth ? (
          <Dock model={model} width={modelWidth} key={modelWidth} isKept={false} />
        ) : null}
      </main>
      <TimeAxis />
      <AttachedStatus address={address} />
      <CommandPalette />
    </div>
  );
}
