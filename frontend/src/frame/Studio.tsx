import '@/i18n/editorTexts';
import { Button, Center, Stack, Text, Title, VisuallyHidden } from '@mantine/core';
import { useMediaQuery } from '@mantine/hooks';
import { useEffect, useLayoutEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { ApiError } from '@/api/errors';
import { closePalette } from '@/commands/palette';
import { useShortcuts } from '@/commands/shortcuts';
import { useMe } from '@/features/accounts/useMe';
import { registerTestCommands } from '@/features/behaviourTests/commands';
import { registerCanvasCommands } from '@/features/canvas/commands/canvasCommands';
import { ConflictDialog } from '@/features/code/ConflictDialog';
import { FileDialog } from '@/features/code/FileDialog';
import { registerDebugCommands } from '@/features/debug/commands';
import { HeldBanner } from '@/features/debug/HeldBanner';
import { PythonBanner } from '@/features/python/PythonBanner';
import { ExportDialog } from '@/features/export/ExportDialog';
import { ApplyDialog } from '@/features/run/ApplyDialog';
import { OwnRobots } from '@/features/run/OwnRobots';
import { TryDialog } from '@/features/tries/TryDialog';
import { RunsDialog } from '@/features/runs/RunsDialog';
import { ArrivalsDialog } from '@/features/library/ArrivalsDialog';
import { ImportDialog } from '@/features/importing/ImportDialog';
import { ImportReport } from '@/features/importReport/ImportReport';
import { Guide } from '@/features/onboarding/guide/Guide';
import { Shortcuts } from '@/features/onboarding/Shortcuts';
import { registerAxisCommands } from '@/features/axis/commands';
import { showMissingRun } from '@/features/axis/showMissingRun';
import { TimeAxis } from '@/features/axis/TimeAxis';
import { RunStrip } from '@/features/run/strip/RunStrip';
import { registerRunCommands } from '@/features/run/commands';
import { registerRateCommands } from '@/features/run/rates';
import { useRunReactions } from '@/features/run/useRunReactions';
import { registerKeyCommands } from '@/features/keys/commands';
import { MomentDialog } from '@/features/behaviourTests/MomentDialog';
import { RenameKeyDialog } from '@/features/keys/RenameKeyDialog';
import { registerSearchCommands } from '@/features/search/commands';
import { registerTopicCommands } from '@/features/topics/commands';
import { ConnectDialog } from '@/features/topics/ConnectDialog';
import { PublishDialog } from '@/features/topics/PublishDialog';
import { NewRobot } from '@/features/robotEditor/NewRobot';
import { Settings } from '@/features/settings/Settings';
import { UniverseDialog } from '@/features/universe/UniverseDialog';
import { NewUniverse } from '@/features/universeEditor/NewUniverse';
import { hasWebGl } from '@/features/viewer/webgl';
import { followAddress } from '@/store/moment/address';
import { followPresent } from '@/store/moment/looking';
import { followPast } from './followPast';
import { followProject } from '@/store/debug/breakpoints';
import { followMarks } from '@/store/debug/marks';
import { followHeat } from '@/store/debug/profile';
import { followBreakpoints } from '@/store/debug/sync';
import { followLines, renameLines } from '@/store/python/lines';
import { followPython } from '@/store/python/sync';
import { useIsBack } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { showsProject } from '@/store/viewMode';
import { setNavigator } from '@/store/project/navigation';
import { navigate } from '@/store/route';
import { followRobots } from '@/store/problems/robots';
import { followTreeRename } from '@/store/session/values/shown';
import { goToInspector, leaveInspector, registerFrameCommands } from './commands';
import { CommandPalette } from '@/workspace/CommandPalette';
import { Dock } from './Dock';
import { FileDrop } from '@/features/importing/FileDrop';
import classes from './frame.module.css';
import { loadLayout } from '@/workspace/layoutModel';
import { openLesson } from '@/workspace/lessons';
import { followSelection } from '@/workspace/lessonTurns';
import { endPresentation, usePresentation } from '@/workspace/presentation';
import { PresentationBar } from './presentation/PresentationBar';
import { RestoredNotice } from './RestoredNotice';
import { StatusBar } from './StatusBar';
import {
  aimAt,
  closeGone,
  bringToFront,
  followFront,
  followNames,
  followRename,
  openTab,
  showTree,
  reopen,
  showPanel,
  useTabs,
} from '@/workspace/tabs';
import { followUse } from '@/workspace/usedPanels';
import { TopBar } from './TopBar';
import { useProject } from './useProject';
import { Waiting } from './Waiting';

interface StudioProps {
  readonly projectId: string;
}

/** The IDE of one project. */
export function Studio({ projectId }: StudioProps) {
  const opening = useProject(projectId);
  if (opening.kind === 'failed') return <CannotOpen error={opening.error} />;
  if (opening.kind === 'loading') return <Waiting reason="openingProject" />;
  return <Workbench projectId={projectId} joined={opening.joined} />;
}

function CannotOpen({ error }: { readonly error: Error }) {
  const { t } = useTranslation('frame');
  const isMissing = error instanceof ApiError && error.status === 404;
  return (
    <Center h="100%" role="alert">
      <Stack maw={480} gap="sm">
        <Title order={1} size="h3">
          {t(isMissing ? 'cannotOpen.missing' : 'cannotOpen.title')}
        </Title>
        <Text c="dimmed">{error.message}</Text>
        <Button w="fit-content" onClick={() => navigate('/')}>
          {t('cannotOpen.back')}
        </Button>
      </Stack>
    </Center>
  );
}

interface WorkbenchProps extends StudioProps {
  readonly joined: Promise<void>;
}

function Workbench({ projectId, joined }: WorkbenchProps) {
  const isNarrow = useMediaQuery('(max-width: 900px)', false, { getInitialValueInEffect: false });
  const width = isNarrow ? 'narrow' : 'wide';
  const model = useTabs((state) => state.model);
  const modelWidth = useTabs((state) => state.width);
  const name = useProjectStore((state) => state.name);
  const presenting = usePresentation((state) => state.mode);
  const isBack = useIsBack();
  useLayoutEffect(showsProject, []); // before the first picture, so that nothing goes away in it
  useShortcuts();
  useRunReactions({ showPanel, openFile: (path, line) => openTab({ kind: 'file', path }, line) });

  const user = useMe()?.user;
  useEffect(() => (user === undefined ? undefined : followProject(user)), [user]);
  useEffect(() => (user === undefined ? undefined : followLines(user)), [user]);

  useEffect(() => {
    document.title = `${name} — BT Studio`;
  }, [name]);

  useEffect(() => {
    const unregister = [
      registerCanvasCommands(),
      registerRunCommands(),
      registerDebugCommands(),
      followBreakpoints(),
      followMarks(),
      followHeat(),
      followPython(),
      followRobots(),
      followSelection(),
      followUse(),
      registerAxisCommands(),
      followPresent(),
      followPast(),
      followAddress(joined, showMissingRun),
      registerRateCommands(),
      registerKeyCommands(),
      registerTestCommands(),
      registerSearchCommands(),
      registerTopicCommands(),
      registerFrameCommands(),
    ];
    setNavigator({
      openTree: (id) => openTab({ kind: 'tree', id }),
      showTree,
      openFile: (path, line) => openTab({ kind: 'file', path }, line),
      showFile: (path) => void bringToFront({ kind: 'file', path }),
      openTopics: () => showPanel('topics'),
      focusField: goToInspector,
      renamed: (kind, from, to) => {
        if (kind === 'file') {
          renameLines(from, to);
          return followRename({ kind, path: from }, { kind, path: to });
        }
        followTreeRename(from, to);
        followRename({ kind, id: from }, { kind, id: to });
      },
      aimAt,
    });
    window.addEventListener('keydown', leaveInspector);
    const unwatch = useProjectStore.subscribe(({ projectId: id, diagrams, files }, before) => {
      if (id === before.projectId && diagrams !== before.diagrams) closeGone();
      if (id === before.projectId && files !== before.files) followNames();
    });
    return () => {
      unwatch();
      window.removeEventListener('keydown', leaveInspector);
      closePalette();
      endPresentation();
      unregister.forEach((undo) => undo?.());
      useTabs.setState({ model: null, target: null });
    };
  }, [joined]);

  useEffect(() => {
    if (model && modelWidth === width) return;
    const fresh = loadLayout(width, hasWebGl());
    useTabs.setState({ model: fresh, width });
    reopen(projectId, useProjectStore.getState().mainTree);
    openLesson(projectId);
    followFront(fresh);
  }, [model, modelWidth, width, projectId]);

  return (
    <div
      className={classes['studio']}
      data-past={isBack || undefined}
      data-presenting={presenting === 'off' ? undefined : presenting}
    >
      <TopBar />
      <RunStrip />
      <HeldBanner />
      <PythonBanner />
      <main className={classes['dock']}>
        {/* The top bar, which has the heading of the page, is hidden then. */}
        {presenting === 'off' ? null : <VisuallyHidden component="h1">{name}</VisuallyHidden>}
        <PresentationBar />
        {model && modelWidth ? <Dock model={model} width={modelWidth} key={modelWidth} /> : null}
      </main>
      <TimeAxis />
      <StatusBar />
      <Guide />
      <CommandPalette />
      <ConflictDialog />
      <FileDialog />
      <ExportDialog />
      <RunsDialog />
      <FileDrop />
      <OwnRobots />
      <ApplyDialog />
      <TryDialog />
      <UniverseDialog />
      <NewUniverse />
      <NewRobot />
      <ImportDialog projectId={projectId} />
      <Settings />
      <Shortcuts />
      <PublishDialog />
      <ConnectDialog />
      <RenameKeyDialog />
      <MomentDialog />
      <ArrivalsDialog />
      <RestoredNotice />
      <ImportReport projectId={projectId} />
    </div>
  );
}
