import { Button, FileButton } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { MOST_STUDY_BYTES, readStudy, type Study } from '@/model/evaluation/study';
import { chooseAgain } from '@/ui/drop/chooseAgain';

/** A button that opens the end of a study, which `bt-studio tune` has written. */
export function OpenStudy({ onOpen }: { readonly onOpen: (study: Study) => void }) {
  const { t } = useTranslation('evaluate');
  const [isWrong, setWrong] = useState(false);
  const open = async (file: File | null) => {
    if (!file) return;
    const study = file.size > MOST_STUDY_BYTES ? null : readStudy(await file.text());
    setWrong(study === null);
    if (study) onOpen(study);
  };
  return (
    <>
      <FileButton onChange={(file) => void open(file)} accept=".json" inputProps={chooseAgain}>
        {(props) => (
          <Button {...props} size="compact-xs" variant="default" title={t('study.what')}>
            {t('study.open')}
          </Button>
        )}
      </FileButton>
      {isWrong ? <p role="alert">{t('study.wrong')}</p> : null}
    </>
  );
}
