import { Button, FileButton, Group, Skeleton, Text, Title, Tooltip } from '@mantine/core';
import { IconChevronDown, IconChevronUp, IconPlus, IconRobot, IconUpload } from '@tabler/icons-react';
import type { RefObject } from 'react';
import { useTranslation } from 'react-i18next';
import { ExampleShelf } from './examples/ExampleShelf';
import { chooseAgain } from '@/ui/drop/chooseAgain';
import classes from './projects.module.css';
import { TemplateCards } from './TemplateCards';
import { isExample } from './examples/shelf';
import { useSortedTemplates } from './templates';
import { useFold } from './useFold';

/**
 * The files that can be imported: project zips of BT Studio and of JdeRobot, trees as XML, projects of Groot2,
 * and Python files with a tree.
 */
const IMPORTS = '.zip,.xml,.btproj,.py,application/zip,text/xml';
/** The placeholders until the server answers: as many as the smallest number of cards. */
const PLACES = [1, 2, 3];

interface NewProjectProps {
  readonly onCreate: (template: string) => void;
  /** The template from which a project is being created. */
  readonly pending: string | null;
  readonly onImport: (file: File) => void;
  readonly isImporting: boolean;
  /** Asks for the address of a robot to follow. */
  readonly onAttach: () => void;
  readonly importButton: RefObject<HTMLButtonElement | null>;
}

/**
 * The section with the ways to begin: templates and examples, which are folded once there are projects, and
 * an import.
 */
export function NewProject({
  onCreate,
  pending,
  onImport,
  isImporting,
  onAttach,
  importButton,
}: NewProjectProps) {
  const { t: ofAttached } = useTranslation('attached');
  const { t } = useTranslation('projects');
  const { isFolded, isKnown, toggle } = useFold();
  const Chevron = isFolded ? IconChevronDown : IconChevronUp;
  return (
    <section aria-labelledby="new-heading">
      <Group justify="space-between" align="end">
        <div>
          <Title order={1} size={26} id="new-heading">
            {t('heading')}
          </Title>
          <Text c="dimmed" mt={4}>
            {t('intro')}
          </Text>
        </div>
        <Group gap="sm">
          {isFolded ? (
            <Button
              data-testid="new-from-empty"
              leftSection={<IconPlus size={16} />}
              loading={pending === 'empty'}
              disabled={pending !== null}
              onClick={() => onCreate('empty')}
            >
              {t('template.empty.name')}
            </Button>
          ) : null}
          <Tooltip label={t('importHint')} multiline maw={300} position="bottom-end">
            <div>
              <FileButton
                accept={IMPORTS}
                inputProps={chooseAgain}
                onChange={(file) => file && onImport(file)}
              >
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
          <Tooltip label={ofAttached('attachHint')} multiline maw={300} position="bottom-end">
            <Button
              variant="default"
              data-testid="attach"
              leftSection={<IconRobot size={16} />}
              onClick={onAttach}
            >
              {ofAttached('attach')}
            </Button>
          </Tooltip>
          <Button
            variant="default"
            data-testid="fold-templates"
            aria-expanded={!isFolded}
            aria-busy={!isKnown}
            aria-controls="beginnings"
            rightSection={<Chevron size={16} />}
            onClick={toggle}
          >
            {t('beginnings')}
          </Button>
        </Group>
      </Group>
      <div id="beginnings">{isFolded ? null : <Shelves onCreate={onCreate} pending={pending} />}</div>
    </section>
  );
}

function Shelves({ onCreate, pending }: Pick<NewProjectProps, 'onCreate' | 'pending'>) {
  const { t } = useTranslation('projects');
  const { all, isKnown } = useSortedTemplates();
  const templates = all.filter(({ id }) => !isExample(id));
  return (
    <>
      <Title order={2} size={18} mt="lg" mb="sm">
        {t('templates')}
      </Title>
      <TemplateCards templates={templates} onCreate={onCreate} pending={pending} />
      {isKnown ? (
        <div className={classes['examplesShelf']}>
          <ExampleShelf onCreate={onCreate} pending={pending} />
        </div>
      ) : (
        <div className={classes['templates']} aria-hidden="true" data-testid="examples-loading">
          {PLACES.map((place) => (
            <Skeleton key={place} height={212} radius="lg" />
          ))}
        </div>
      )}
    </>
  );
}
