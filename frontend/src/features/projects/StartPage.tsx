import { Button, FileButton, Group, Loader, Overlay, Text, Title, Tooltip } from '@mantine/core';
import { IconUpload } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { Suspense, useEffect, useRef } from 'react';
import { closePalette, usePalette } from '@/commands/palette';
import { useShortcuts } from '@/commands/shortcuts';
import { UserMenu } from '@/features/accounts/UserMenu';
import { ThemeToggle } from '@/ui/ThemeToggle';
import { Logo } from '@/ui/Logo';
import { lazyPart } from '@/ui/parts';
import { ExampleShelf } from './examples/ExampleShelf';
import { LanguageMenu } from './LanguageMenu';
import { ProjectList } from './ProjectList';
import classes from './projects.module.css';
import { RepairDialog } from './RepairDialog';
import { TemplateCards } from './TemplateCards';
import { useFileDrop } from './useFileDrop';
import { useImport } from './useImport';
import { useProjectCommands } from './useProjects';
import { useStartCommands } from './useStartCommands';

const CommandPalette = lazyPart(async () => (await import('@/workspace/CommandPalette')).CommandPalette);

/** Project zips of BT Studio and of JdeRobot, trees as XML, and projects of Groot2. */
const IMPORTS = '.zip,.xml,.btproj,application/zip,text/xml';

/** The page that lists the projects and creates new ones. */
export function StartPage() {
  const { t } = useTranslation('projects');
  const actions = useProjectCommands();
  const { importFile, isImporting, offer, repair, decline } = useImport();
  const isDropping = useFileDrop(importFile);
  const pending = actions.create.isPending ? actions.create.variables : null;

  const isPaletteOpen = usePalette((state) => state.page !== null);
  const importButton = useRef<HTMLButtonElement>(null);
  const searchField = useRef<HTMLInputElement>(null);
  useShortcuts();
  useStartCommands({
    create: (template) => actions.create.mutate(template),
    chooseFile: () => importButton.current?.click(),
    search: () => searchField.current?.focus(),
  });

  useEffect(() => {
    document.title = 'BT Studio';
    return closePalette;
  }, []);

  return (
    <div className={classes['page']}>
      {isDropping ? (
        <Overlay fixed zIndex={300} backgroundOpacity={0.5} blur={2} className={classes['dropOverlay']}>
          <IconUpload size={40} />
          <Text size="lg" fw={600}>
            {t('dropHere')}
          </Text>
        </Overlay>
      ) : null}
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
        <section aria-labelledby="new-heading">
          <Group justify="space-between" align="end" mb="md">
            <div>
              <Title order={1} size={26} id="new-heading">
                {t('heading')}
              </Title>
              <Text c="dimmed" mt={4}>
                {t('intro')}
              </Text>
            </div>
            <Tooltip label={t('importHint')} multiline maw={300} position="bottom-end">
              <div>
                <FileButton accept={IMPORTS} onChange={(file) => file && importFile(file)}>
                  {(props) => (
                    <Button
                      {...props}
                      ref={importButton}
                      variant="default"
                      data-testid="import"
                      loading={isImporting}
                      leftSection={<IconUpload size={16} />}
                    >
                      {t('import')}
                    </Button>
                  )}
                </FileButton>
              </div>
            </Tooltip>
          </Group>
          <TemplateCards onCreate={(template) => actions.create.mutate(template)} pending={pending} />
        </section>
        <ExampleShelf onCreate={(template) => actions.create.mutate(template)} pending={pending} />
        <ProjectList actions={actions} searchField={searchField} />
        {isImporting ? (
          <Group gap="sm" role="status">
            <Loader size="xs" />
            <Text size="sm">{t('importing')}</Text>
          </Group>
        ) : null}
      </main>
      <RepairDialog offer={offer} onRepair={repair} onClose={decline} />
      {isPaletteOpen ? (
        <Suspense fallback={null}>
          <CommandPalette />
        </Suspense>
      ) : null}
    </div>
  );
}
