import { Group, Loader, Text } from '@mantine/core';
import { useTranslation } from 'react-i18next';
import { Suspense, useCallback, useEffect, useRef, useState } from 'react';
import { closePalette, usePalette } from '@/commands/palette';
import { useShortcuts } from '@/commands/shortcuts';
import { SharedRightsNotice } from '@/features/accounts/SharedRightsNotice';
import { UserMenu } from '@/features/accounts/UserMenu';
import { AttachDialog } from '@/features/attached/AttachDialog';
import { MyRuns } from '@/features/runs/MyRuns';
import { isLog, openNewLog } from '@/features/runs/openNewLog';
import { DropOverlay } from '@/ui/drop/DropOverlay';
import { ThemeToggle } from '@/ui/ThemeToggle';
import { Logo } from '@/ui/Logo';
import { lazyPart } from '@/ui/parts';
import { LanguageMenu } from './LanguageMenu';
import { NewProject } from './NewProject';
import { ProjectList } from './ProjectList';
import classes from './projects.module.css';
import { MainTreeDialog } from './MainTreeDialog';
import { OrderDialog } from './OrderDialog';
import { RepairDialog } from './RepairDialog';
import { useFileDrop } from '@/ui/hooks/useFileDrop';
import { useImport } from './useImport';
import { useProjectCommands } from './useProjects';
import { useStartCommands } from './useStartCommands';

const CommandPalette = lazyPart(async () => (await import('@/workspace/CommandPalette')).CommandPalette);

interface Props {
  /** Loads the page of a project in advance. */
  readonly loadStudio?: () => Promise<unknown>;
  /** Loads the page of an attached session in advance. */
  readonly loadAttached?: () => Promise<unknown>;
}

/** The page that lists the projects and creates new ones. */
export function StartPage({ loadStudio, loadAttached }: Props) {
  const { t } = useTranslation('projects');
  const actions = useProjectCommands();
  const { importFile, isImporting, offer, repair, mainTrees, chooseMain, orders, chooseOrder, decline } =
    useImport();
  const { t: ofRuns } = useTranslation('runs');
  const drop = useCallback(
    (file: File) => (isLog(file) ? void openNewLog(file, ofRuns) : importFile(file)),
    [importFile, ofRuns],
  );
  const isDropping = useFileDrop(drop);
  const pending = actions.create.isPending ? actions.create.variables : null;

  const isPaletteOpen = usePalette((state) => state.page !== null);
  const importButton = useRef<HTMLButtonElement>(null);
  const searchField = useRef<HTMLInputElement>(null);
  const [isAttaching, setAttaching] = useState(false);
  useShortcuts();
  useStartCommands({
    create: (template) => actions.create.mutate(template),
    chooseFile: () => importButton.current?.click(),
    attach: () => setAttaching(true),
    search: () => searchField.current?.focus(),
  });

  useEffect(() => {
    document.title = 'BT Studio';
    return closePalette;
  }, []);
  useEffect(() => {
    // A failure is reported when a project is opened, which loads again.
    loadStudio?.().catch(() => undefined);
  }, [loadStudio]);

  return (
    <div className={classes['page']}>
      {isDropping ? <DropOverlay>{t('dropHere')}</DropOverlay> : null}
      <header className={classes['header']}>
        <Group gap={10}>
          <Logo size={28} />
          <Text fw={700} size="lg">
            BT Studio
          </Text>
        </Group>
        <Group gap={4}>
          <LanguageMenu />
          <ThemeToggle />
          <UserMenu />
        </Group>
      </header>
      <main className={classes['main']}>
        <SharedRightsNotice />
        <NewProject
          onCreate={(template) => actions.create.mutate(template)}
          pending={pending}
          onImport={importFile}
          isImporting={isImporting}
          onAttach={() => setAttaching(true)}
          importButton={importButton}
        />
        <ProjectList actions={actions} searchField={searchField} />
        <MyRuns />
        {isImporting ? (
          <Group gap="sm" role="status">
            <Loader size="xs" />
            <Text size="sm">{t('importing')}</Text>
          </Group>
        ) : null}
      </main>
      <AttachDialog isOpen={isAttaching} onOpen={loadAttached} onClose={() => setAttaching(false)} />
      <RepairDialog offer={offer} onRepair={repair} onClose={decline} />
      {mainTrees ? <MainTreeDialog offer={mainTrees} onChoose={chooseMain} onClose={decline} /> : null}
      {orders ? <OrderDialog offer={orders} onChoose={chooseOrder} onClose={decline} /> : null}
      {isPaletteOpen ? (
        <Suspense fallback={null}>
          <CommandPalette />
        </Suspense>
      ) : null}
    </div>
  );
}
