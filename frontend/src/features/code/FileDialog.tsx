import { notifications } from '@mantine/notifications';
import { Button, Group, Modal, Radio, Stack, TextInput } from '@mantine/core';
import { useState, type FormEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { ENUMS_FILE, NEW_ENUMS } from '@/model/enums';
import { useProjectStore } from '@/store/project';
import { documentName, kindOf } from '@/store/project/moving';
import { openFile, openTree } from '@/store/project/navigation';
import { treeIdOf } from '@/store/project/state';
import { withAllPython } from '@/store/saving/large';
import { nameProblem, pathFor } from './names';
import {
  closeFileDialog,
  useFileDialog,
  type FileDialog as Dialog,
  type NamedKind,
} from '@/store/dialogs/files';
import { renameDocument } from './renaming';
import { ACTION_TEMPLATES, actionSource, type ActionTemplate } from './templates';

/**
 * A dialogue for the name of a new file (with the kind of an action), or for a new name of an existing file.
 */
export function FileDialog() {
  const { t } = useTranslation('code');
  const dialog = useFileDialog((state) => state.dialog);
  const key = dialog?.mode === 'new' ? `new.${dialog.kind}` : 'rename';
  return (
    <Modal opened={dialog !== null} onClose={closeFileDialog} title={t(`dialog.${key}`)} size="sm">
      {dialog ? <Form key={JSON.stringify(dialog)} dialog={dialog} /> : null}
    </Modal>
  );
}

const kindOfDialog = (dialog: NonNullable<Dialog>): NamedKind =>
  dialog.mode === 'new' ? dialog.kind : kindOf(dialog.path);

function create(kind: NamedKind, name: string, template: ActionTemplate): void {
  const project = useProjectStore.getState();
  const path = pathFor(kind, name);
  if (kind === 'tree') {
    project.addTree(name);
    return openTree(name);
  }
  const empty = path === ENUMS_FILE ? NEW_ENUMS : '';
  project.addFile(path, kind === 'action' ? actionSource(name, template) : empty);
  openFile(path);
}

function rename(path: string, name: string): void {
  const project = useProjectStore.getState();
  const treeId = treeIdOf(path);
  if (treeId !== null) {
    project.renameTree(treeId, name);
    return openTree(name);
  }
  if (kindOf(path) !== 'action') {
    renameDocument(path, name).catch((error: Error) =>
      notifications.show({ color: 'red', message: error.message }),
    );
    return;
  }
  withAllPython().then(
    () => {
      project.renameAction(documentName(path), name);
      openFile(pathFor('action', name));
    },
    (error: Error) => notifications.show({ color: 'red', message: error.message }),
  );
}

function Form({ dialog }: { readonly dialog: NonNullable<Dialog> }) {
  const { t } = useTranslation('code');
  const kind = kindOfDialog(dialog);
  const before = dialog.mode === 'rename' ? documentName(dialog.path) : '';
  const [name, setName] = useState(before);
  const [template, setTemplate] = useState<ActionTemplate>('action');
  const [isTouched, setTouched] = useState(false);
  const files = useProjectStore((state) => state.files);
  const specs = useProjectStore((state) => state.vocabulary.specs);
  const problem =
    name === before && dialog.mode === 'rename'
      ? null
      : nameProblem(kind, name, { paths: Object.keys(files), types: new Set(specs.keys()) });

  const submit = (event: FormEvent) => {
    event.preventDefault();
    setTouched(true);
    if (problem) return;
    closeFileDialog();
    if (dialog.mode === 'new') create(kind, name, template);
    else if (name !== before) rename(dialog.path, name);
  };

  return (
    <form onSubmit={submit}>
      <Stack gap="md">
        <TextInput
          data-autofocus
          label={t(`dialog.name.${kind}`)}
          placeholder={t(`dialog.example.${kind}`)}
          value={name}
          error={isTouched && problem ? t(`dialog.problem.${problem}`) : null}
          onChange={(event) => {
            setName(event.currentTarget.value);
            setTouched(event.currentTarget.value !== '');
          }}
        />
        {kind === 'action' && dialog.mode === 'new' ? (
          <Radio.Group
            label={t('dialog.startFrom')}
            value={template}
            onChange={(value) => setTemplate(value as ActionTemplate)}
          >
            <Stack gap="xs" mt="xs">
              {ACTION_TEMPLATES.map((each) => (
                <Radio
                  key={each}
                  value={each}
                  label={t(`dialog.template.${each}.name`)}
                  description={t(`dialog.template.${each}.text`)}
                />
              ))}
            </Stack>
          </Radio.Group>
        ) : null}
        <Group justify="flex-end">
          <Button variant="default" onClick={closeFileDialog}>
            {t('dialog.cancel')}
          </Button>
          <Button type="submit" data-testid="file-dialog-ok">
            {t(dialog.mode === 'new' ? 'dialog.create' : 'dialog.rename')}
          </Button>
        </Group>
      </Stack>
    </form>
  );
}
